#pragma once

#include <ros/ros.h>

#include <vector>

#include "deformable_manipulation/ClearPerturbations.h"
#include "deformable_manipulation/HoldParticle.h"
#include "deformable_manipulation/ReleaseParticle.h"
#include "deformable_manipulation/SetMaterial.h"
#include "deformable_manipulation/SetPerturbations.h"
#include "deformable_manipulation/pbd/simulation.h"

namespace deformable_manipulation {

//! Services that change the object while it is simulated: copies, holds, material.
//!
//! Each either does everything that is asked or changes nothing and says why.
class ObjectServices {
 public:
  ObjectServices(ros::NodeHandle& node, pbd::Simulation& simulation);

 private:
  bool setPerturbations(SetPerturbations::Request& request, SetPerturbations::Response& response);
  bool clearPerturbations(ClearPerturbations::Request& request, ClearPerturbations::Response& response);
  bool hold(HoldParticle::Request& request, HoldParticle::Response& response);
  bool release(ReleaseParticle::Request& request, ReleaseParticle::Response& response);
  bool setMaterial(SetMaterial::Request& request, SetMaterial::Response& response);
  std::string copiesNow() const;

  pbd::Simulation& simulation_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace deformable_manipulation
