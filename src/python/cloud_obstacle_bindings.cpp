// Obstacles of points for Python.

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "deformable_manipulation/distance/cloud_obstacle.h"
#include "deformable_manipulation/distance/depth_smoothing.h"
#include "deformable_manipulation/distance/near_elements.h"
#include "distance_arguments.h"

namespace py = pybind11;
using namespace deformable_manipulation::distance;

namespace {

template <typename Number>
std::shared_ptr<PointCloud> made(const py::array& given) {
  const py::array_t<Number, py::array::c_style | py::array::forcecast> points(given);
  const py::gil_scoped_release others_go_on;
  return std::make_shared<PointCloud>(points.data(), static_cast<std::size_t>(points.shape(0)));
}

void requirePoints(const py::array& given) {
  if (given.ndim() != 2 || given.shape(1) != 3 || std::string("fiu").find(given.dtype().kind()) == std::string::npos) {
    throw py::value_error("points must be numbers of the shape (points, 3)");
  }
}

std::shared_ptr<PointCloud> toCloud(const py::array& given) {
  requirePoints(given);
  return given.dtype().is(py::dtype::of<float>()) ? made<float>(given) : made<double>(given);
}

using Clouds = std::vector<std::shared_ptr<const PointCloud>>;

std::vector<NearElement> toElements(const Points& corners, const Points& reaches, const Points& farthest) {
  if (corners.ndim() != 3 || corners.shape(1) != 3 || corners.shape(2) != 3) {
    throw py::value_error("elements must have the shape (elements, 3, 3)");
  }
  if (reaches.ndim() != 1 || reaches.shape(0) != corners.shape(0)) {
    throw py::value_error("there must be one reach for each element");
  }
  if (farthest.size() > 0 && (farthest.ndim() != 1 || farthest.shape(0) != corners.shape(0))) {
    throw py::value_error("there must be one farthest distance for each element, or none");
  }
  std::vector<NearElement> elements(static_cast<std::size_t>(corners.shape(0)));
  for (std::size_t i = 0; i < elements.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      elements[i].corners[k] = Eigen::Map<const Vector3>(corners.data() + 9 * i + 3 * k);
    }
    elements[i].reach = reaches.data()[i];
    if (farthest.size() > 0) {
      elements[i].farthest = farthest.data()[i];
    }
  }
  return elements;
}

template <typename Number>
py::array_t<bool> marked(const py::array& given, const NearElements& elements) {
  const py::array_t<Number, py::array::c_style | py::array::forcecast> points(given);
  py::array_t<bool> marks(points.shape(0));
  bool* to = marks.mutable_data();
  const py::gil_scoped_release others_go_on;
  elements.mark(points.data(), static_cast<std::size_t>(points.shape(0)), to);
  return marks;
}

py::array_t<bool> nearElements(const py::array& points, const Points& corners, const Points& reaches,
                               const Points& farthest, const Numbers3& origin, double doubt) {
  requirePoints(points);
  const NearElements elements(toElements(corners, reaches, farthest), Rays{toVector(origin), doubt});
  return points.dtype().is(py::dtype::of<float>()) ? marked<float>(points, elements) : marked<double>(points, elements);
}

using Depths = py::array_t<float, py::array::c_style | py::array::forcecast>;

Depths smoothed(const Depths& depths, double noise) {
  if (depths.ndim() != 2) {
    throw py::value_error("depths must have the shape (rows, columns)");
  }
  if (!(noise > 0.0 && std::isfinite(noise))) {
    throw py::value_error("noise must be a number above 0");
  }
  Depths factors({depths.shape(0), depths.shape(1)});
  float* to = factors.mutable_data();
  const py::gil_scoped_release others_go_on;
  smoothDepths(depths.data(), static_cast<int>(depths.shape(0)), static_cast<int>(depths.shape(1)), noise, to);
  return factors;
}

}  // namespace

void bindCloudObstacle(py::module_& module) {
  py::class_<PointCloud, std::shared_ptr<PointCloud>>(
      module, "PointCloud",
      "Points (N, 3) [m] that are ready to be searched; those that are not finite or beyond 1e6 m are left out.\n\n"
      "It never changes, and other threads of Python go on while it is made. Raises ValueError: points have another\n"
      "shape or type.")
      .def(py::init(&toCloud), py::arg("points"))
      .def("__len__", &PointCloud::size)
      .def_property_readonly("left_out", &PointCloud::leftOut, "How many points are left out.")
      .def_property_readonly("bytes", &PointCloud::bytes, "Memory that it takes.");
  py::class_<CloudObstacle, Obstacle, std::shared_ptr<CloudObstacle>>(
      module, "CloudObstacle",
      "The points of one or several PointCloud, or of none, as balls of one radius [m], 0 or more.\n\n"
      "Raises ValueError: the radius is wrong.")
      .def(py::init([](const std::shared_ptr<PointCloud>& cloud, double radius) {
             return std::make_shared<CloudObstacle>(Clouds{cloud}, radius);
           }),
           py::arg("cloud"), py::arg("radius"))
      .def(py::init([](const std::vector<std::shared_ptr<PointCloud>>& clouds, double radius) {
             return std::make_shared<CloudObstacle>(Clouds(clouds.begin(), clouds.end()), radius);
           }),
           py::arg("clouds"), py::arg("radius"));
  module.def(
      "near_elements", &nearElements, py::arg("points"), py::arg("elements"), py::arg("reaches"),
      py::arg("farthest") = Points(0), py::arg("origin") = Numbers3{0.0, 0.0, 0.0}, py::arg("doubt") = 0.0,
      "Which of the points (N, 3) [m] are within the reaches (E,) [m] of elements (E, 3, 3) [m]: triangles, or\n"
      "segments as start, end, end, or points three times. Flags (N,); points that are not finite are near "
      "nothing.\n\n"
      "With a doubt [1/m], a point at the distance r from the origin (3,) [m] may be elsewhere on its ray, by up\n"
      "to doubt * r^2 either way; points themselves farther away than `farthest` (E,) [m] do not count.\n"
      "Raises ValueError: a shape is wrong, or a number of an element or the rays is not finite.");
  module.def(
      "smoothing_factors", &smoothed, py::arg("depths"), py::arg("noise"),
      "Factors (H, W), by which to multiply the points of a depth image (H, W) [m] to smooth them. Its noise is\n"
      "normal, with the standard deviation noise * depth^2, with `noise` [m] at 1 m. Where the depths of 5 x 5\n"
      "pixels do not lie on a plane as well as that explains, or less than half of them are known, the factor is "
      "1.\n"
      "No point moves by more than five standard deviations. Raises ValueError: a shape or the noise is wrong.");
}
