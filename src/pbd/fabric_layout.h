#pragma once

#include <Eigen/Core>
#include <vector>

#include "deformable_manipulation/pbd/body.h"
#include "deformable_manipulation/pbd/fabric_parameters.h"
#include "fabric_mesh.h"

namespace deformable_manipulation {
namespace pbd {

//! A first guess of a held fabric's shape, to be settled: the unstretched shape, turned so that it fits the holds as
//! well as it can and hangs from them, blended into their positions, and with the sag of a membrane that gives
//! the edges their lengths on average.
//! @param weights  holdWeights() of the holds
//! @return the vertices, the held ones at their own places
std::vector<Vector3> layOutFabric(const FabricParameters& fabric, const std::vector<MeshEdge>& edges,
                                  const std::vector<HeldPoint>& holds, const Eigen::MatrixXd& weights);

//! Mean elongation of the edges, weighted with the area of their triangles.
double meanElongation(const std::vector<MeshEdge>& edges, const std::vector<Vector3>& vertices);

}  // namespace pbd
}  // namespace deformable_manipulation
