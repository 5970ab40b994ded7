#include "fabric_layout.h"

#include <Eigen/SVD>
#include <algorithm>
#include <utility>

#include "fabric_weights.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

// Of how the fabric hangs, and then of its own orientation, against how it fits the holds, where these leave it open.
constexpr double kHanging = 1e-3;
constexpr double kOrientation = 1e-6;

// A fabric that is shorter than this by no more on average needs no sag.
constexpr double kUnstretched = 1e-9;

Vector3 mean(const std::vector<Vector3>& points) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& point : points) {
    sum += point;
  }
  return sum / static_cast<double>(points.size());
}

//! The rotation R that maximises trace(R^T correlation).
Eigen::Matrix3d rotationOf(const Eigen::Matrix3d& correlation) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(correlation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0.0) {
    u.col(2) = -u.col(2);
  }
  return u * svd.matrixV().transpose();
}

Vector3 downwards(const FabricParameters& fabric) {
  const double g = fabric.gravity.norm();
  return g > 0.0 ? Vector3(fabric.gravity / g) : Vector3::Zero();
}

//! The unstretched shape, moved as a whole to the holds.
std::vector<Vector3> movedToHolds(const FabricParameters& fabric, const std::vector<HeldPoint>& holds) {
  std::vector<Vector3> rest, held;
  for (const HeldPoint& hold : holds) {
    rest.push_back(fabric.vertices[hold.particle]);
    held.push_back(hold.pose.position);
  }
  const Vector3 from = mean(rest);
  const Vector3 to = mean(held);
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  double size = 0.0;
  for (std::size_t i = 0; i < holds.size(); ++i) {
    correlation += (held[i] - to) * (rest[i] - from).transpose();
  }
  for (const Vector3& vertex : fabric.vertices) {
    size = std::max(size, (vertex - from).norm());
  }
  correlation += kHanging * size * downwards(fabric) * (mean(fabric.vertices) - from).transpose();
  correlation += kOrientation * size * size * fabric.pose.orientation.toRotationMatrix();
  const Eigen::Matrix3d rotation = rotationOf(correlation);
  std::vector<Vector3> moved;
  for (const Vector3& vertex : fabric.vertices) {
    moved.push_back(to + rotation * (vertex - from));
  }
  return moved;
}

std::vector<Vector3> displaced(std::vector<Vector3> vertices, const Eigen::VectorXd& by, const Vector3& direction) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    vertices[i] += by[static_cast<int>(i)] * direction;
  }
  return vertices;
}

//! Lets a fabric whose edges are too short hang down until they are long enough.
std::vector<Vector3> sagged(const FabricParameters& fabric, const std::vector<MeshEdge>& edges,
                            const std::vector<int>& held, const std::vector<Vector3>& vertices) {
  const Vector3 down = downwards(fabric);
  if (meanElongation(edges, vertices) > -kUnstretched || down.isZero()) {
    return vertices;
  }
  const int n = static_cast<int>(vertices.size());
  const Eigen::VectorXd sag = solveHeld(membraneMatrix(n, edges), held,
                                        Eigen::VectorXd::Zero(static_cast<int>(held.size())), Eigen::VectorXd::Ones(n));
  if (!(sag.maxCoeff() > 0.0)) {  // every vertex is held
    return vertices;
  }
  double size = 0.0;
  for (const MeshEdge& edge : edges) {
    size += edge.length;
  }
  double least = 0.0;
  double most = size / sag.maxCoeff();  // then edges are too long together
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (least + most);
    (meanElongation(edges, displaced(vertices, middle * sag, down)) < 0.0 ? least : most) = middle;
  }
  return displaced(vertices, least * sag, down);
}

}  // namespace

double meanElongation(const std::vector<MeshEdge>& edges, const std::vector<Vector3>& vertices) {
  double sum = 0.0;
  double area = 0.0;
  for (const MeshEdge& edge : edges) {
    const double length = (vertices[edge.vertices[1]] - vertices[edge.vertices[0]]).norm();
    sum += edge.area * (length / edge.length - 1.0);
    area += edge.area;
  }
  return sum / area;
}

std::vector<Vector3> layOutFabric(const FabricParameters& fabric, const std::vector<MeshEdge>& edges,
                                  const std::vector<HeldPoint>& holds, const Eigen::MatrixXd& weights) {
  if (holds.empty()) {
    std::vector<Vector3> vertices;
    for (const Vector3& vertex : fabric.vertices) {
      vertices.push_back(fabric.pose.position + fabric.pose.orientation * vertex);
    }
    return vertices;
  }
  std::vector<Vector3> vertices = movedToHolds(fabric, holds);
  std::vector<int> held;
  std::vector<Vector3> misfit;
  for (const HeldPoint& hold : holds) {
    held.push_back(hold.particle);
    misfit.push_back(hold.pose.position - vertices[hold.particle]);
  }
  for (std::size_t h = 0; h < held.size(); ++h) {
    vertices = displaced(std::move(vertices), weights.col(static_cast<int>(h)), misfit[h]);
  }
  return sagged(fabric, edges, held, vertices);
}

}  // namespace pbd
}  // namespace deformable_manipulation
