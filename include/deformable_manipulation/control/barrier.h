#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "deformable_manipulation/control/constraint_rows.h"
#include "deformable_manipulation/control/features.h"
#include "deformable_manipulation/control/object_shape.h"
#include "deformable_manipulation/control/predicted_state.h"
#include "deformable_manipulation/control/team.h"
#include "deformable_manipulation/parameters/parameter_section.h"

namespace deformable_manipulation {
namespace control {

//! The state from which a barrier's value is computed.
struct PresentState {
  std::vector<Vector3> positions;  //!< [A] m, held points
  double distance;                 //!< [m] signed minimum of the object; infinite: no obstacle
  ObjectShape shape = {};          //!< of the object, as far as it is known
};

//! The rows of one barrier: they share its slack.
class BarrierRows {
 public:
  //! @param kind of the barrier's rows, see ConstraintRows
  //! @param anticipation kind of the rows that are wishes
  BarrierRows(ConstraintRows& rows, int kind, int anticipation)
      : rows_(rows), kind_(kind), anticipation_(anticipation) {}

  //! Adds coefficients . u >= bound [m/s] as a limit.
  //! @return the coefficients [3 M], zeros to be filled in before the next row is added
  Eigen::Map<Eigen::VectorXd> limit(double bound) { return rows_.add(kind_, bound); }

  //! Adds the same as a wish, which yields to every limit.
  Eigen::Map<Eigen::VectorXd> anticipate(double bound) { return rows_.add(anticipation_, bound); }

 private:
  ConstraintRows& rows_;
  int kind_;
  int anticipation_;
};

//! Keeps quantities h from becoming negative, by constraints dh/dt >= -alpha(h) on the commanded velocities.
//!
//! A barrier is two files in barriers/, found by their names at build time, and a declaration of its parameters in
//! Python; CONTRIBUTING.md shows how to add one.
class Barrier {
 public:
  virtual ~Barrier() = default;

  //! The lowest h of an agent, without margins; infinite if nothing limits it. In m, unless the barrier's declaration
  //! says otherwise.
  virtual double value(const PresentState& state, int agent) const = 0;

  //! [m] How far a state is within the limits of an agent, for the search for detours: the value, if that is a length.
  virtual double clearance(const PresentState& state, int agent) const { return value(state, agent); }

  //! Adds the constraints on the velocities of the commanded assistants.
  virtual void addRows(const Features& features, const PredictedState& state, BarrierRows& rows) const = 0;

  //! Whether its rows need to know how the object's shape follows its held points, even far from all obstacles.
  virtual bool needsResponse() const { return false; }
};

//! Makes a barrier from its section of the scenario.
using BarrierMaker = std::function<std::unique_ptr<Barrier>(const ParameterSection& section, const Team& team)>;

//! Makes barriers by their names, from the section `controller`.
//! @throw std::invalid_argument if there is no barrier of a name; pbd::ParameterError for everything wrong in the
//! section
std::vector<std::unique_ptr<Barrier>> makeBarriers(const std::vector<std::string>& names,
                                                   const ParameterValue& controller, const Team& team);

//! The functions that make the barriers, by name.
const std::map<std::string, BarrierMaker>& barrierMakers();

}  // namespace control
}  // namespace deformable_manipulation
