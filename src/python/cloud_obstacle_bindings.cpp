// Obstacles of points for Python.

#include <memory>
#include <string>

#include "deformable_manipulation/distance/cloud_obstacle.h"
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

std::shared_ptr<PointCloud> toCloud(const py::array& given) {
  if (given.ndim() != 2 || given.shape(1) != 3 || std::string("fiu").find(given.dtype().kind()) == std::string::npos) {
    throw py::value_error("points must be numbers of the shape (points, 3)");
  }
  return given.dtype().is(py::dtype::of<float>()) ? made<float>(given) : made<double>(given);
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
      module, "CloudObstacle", "The points of a PointCloud as balls of one radius [m], 0 or more; it may be empty.")
      .def(py::init([](const std::shared_ptr<PointCloud>& cloud, double radius) {
             return std::make_shared<CloudObstacle>(cloud, radius);
           }),
           py::arg("cloud"), py::arg("radius"))
      .def(
          "set_cloud",
          [](CloudObstacle& obstacle, const std::shared_ptr<PointCloud>& cloud) { obstacle.setCloud(cloud); },
          py::arg("cloud"), "Another cloud from the next computation on.");
}
