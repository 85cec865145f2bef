// SPDX-License-Identifier: MIT
// Rods in space: section, material, supports, loads, natural shape.
#include <array>
#include <functional>
#include <pybind11/functional.h>
#include <pybind11/stl.h>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "enums.hpp"
#include "module.hpp"
#include <hapbeam/shapes.hpp>

namespace hapbeam::python {
namespace {

using py::arg;
constexpr auto itself = py::return_value_policy::reference_internal;

void add_rod_sections(py::module_& m) {
  py::class_<RodSection>(m, "RodSection", "Cross-section of a rod, with its principal axes along d1 and d2.")
      .def_static("rectangle", &RodSection::rectangle, arg("width"), arg("height"),
                  "width [m] along d1, height [m] along d2.")
      .def_static("circle", &RodSection::circle, arg("diameter"), "diameter [m].")
      .def_static("tube", &RodSection::tube, arg("outer_diameter"), arg("inner_diameter"), "Diameters [m].")
      .def_static("ellipse", &RodSection::ellipse, arg("width"), arg("height"),
                  "Diameters [m] along d1 and d2.")
      .def_readonly("area", &RodSection::area, "[m²]")
      .def_readonly("inertia1", &RodSection::inertia1, "I about d1 [m⁴]")
      .def_readonly("inertia2", &RodSection::inertia2, "I about d2 [m⁴]")
      .def_readonly("torsion", &RodSection::torsion, "J [m⁴]")
      .def_readonly("thickness", &RodSection::thickness, "[m] smallest extent");
  py::class_<RodMaterial>(m, "RodMaterial", "Linear elastic material.")
      .def(py::init([](double young, double shear) {
             return RodMaterial{young, shear};
           }),
           arg("young"), arg("shear"), "Young's modulus and shear modulus [Pa].")
      .def_static(
          "isotropic", [](double young, double poisson) { return RodMaterial::isotropic(young, poisson); },
          arg("young"), arg("poisson"), "Young's modulus [Pa] and Poisson's ratio.")
      .def_readonly("young", &RodMaterial::young, "[Pa]")
      .def_readonly("shear", &RodMaterial::shear, "[Pa]");
}

void add_rod_ends(py::module_& m) {
  py::class_<RodSupport>(m, "RodSupport", "How an end of a rod is held.")
      .def_static("elastic", &RodSupport::elastic, arg("place1"), arg("place2"), arg("along"), arg("turn1"),
                  arg("turn2"), arg("twist"),
                  "Springs: 0 leaves a motion free, infinity holds it.  Places [N/m], turns and twist "
                  "[N·m/rad].")
      .def_readonly_static("free", &RodSupport::free, "Not held at all.")
      .def_readonly_static("clamped", &RodSupport::clamped, "Place, direction and twist.")
      .def_readonly_static("hinged", &RodSupport::hinged, "Place: a ball joint.")
      .def_readonly_static("cardan", &RodSupport::cardan, "Place and twist: a universal joint.")
      .def_readonly_static("sliding", &RodSupport::sliding, "All but the place along the rod: a sleeve.")
      .def("__eq__", [](const RodSupport& a, const RodSupport& b) { return a == b; })
      .def("__repr__", [](const RodSupport& a) { return std::string("RodSupport.") + name(a); });
  py::class_<RodPose>(m, "RodPose", "Where an end of a rod is, and how its section is turned.")
      .def(py::init([](const Numbers& at, const Numbers& along, const Numbers& director) {
             return RodPose{vector_of<3>(at, "at"), vector_of<3>(along, "along"),
                            vector_of<3>(director, "director")};
           }),
           arg("at") = std::array<double, 3>{0, 0, 0}, arg("along") = std::array<double, 3>{1, 0, 0},
           arg("director") = std::array<double, 3>{0, 1, 0},
           "at [m], along: direction of the tangent from left to right, director: d1 of the section.")
      .def_property_readonly(
          "at", [](const RodPose& pose) { return array_of(pose.at); }, "[m]")
      .def_property_readonly(
          "along", [](const RodPose& pose) { return array_of(pose.along); }, "d3")
      .def_property_readonly(
          "director", [](const RodPose& pose) { return array_of(pose.director); }, "d1");
}

void add_rod_loads(py::class_<Rod>& rod) {
  rod.def(
         "weight",
         [](Rod& self, double density, const Numbers& gravity) -> Rod& {
           return self.weight(density, vector_of<3>(gravity, "gravity"));
         },
         arg("density"), arg("gravity"), itself, "Its own weight: density [kg/m³], gravity [m/s²].")
      .def(
          "load",
          [](Rod& self, const Numbers& load) -> Rod& { return self.load(vector_of<3>(load, "load")); },
          arg("load"), itself, "A distributed dead load [N/m].")
      .def(
          "add",
          [](Rod& self, double s, const Numbers& force, const Numbers& moment) -> Rod& {
            return self.add(RodForce{s, vector_of<3>(force, "force"), vector_of<3>(moment, "moment")});
          },
          arg("s"), arg("force") = std::array<double, 3>{0, 0, 0},
          arg("moment") = std::array<double, 3>{0, 0, 0}, itself,
          "A dead force [N] and a moment [N m] at arc position s [m].")
      .def(
          "foundation",
          [](Rod& self, double from, double to, double across, double along) -> Rod& {
            return self.add(RodFoundation{from, to, across, along});
          },
          arg("start"), arg("end"), arg("across"), arg("along") = 0.0, itself,
          "Springs between two arc positions [m]: force per length and displacement [N/m²].");
}

void add_rod_shape(py::class_<Rod>& rod) {
  rod.def(
         "naturally",
         [](Rod& self, const std::vector<std::array<double, 4>>& arcs) -> Rod& {
           std::vector<RodArc> all;
           for (const auto& arc : arcs) all.push_back({arc[0], arc[1], arc[2], arc[3]});
           return self.naturally(std::move(all));
         },
         arg("arcs"), itself,
         "A natural shape of arcs (end, curvature1, curvature2, twist): arc position [m] at which each ends, "
         "curvatures about d1 and d2 and twist [1/m].  One of constant curvature and twist is a helix.")
      .def("section", &Rod::section, arg("by_s"), itself,
           "A section that changes along the rod: a function of arc position [m] that returns a RodSection.")
      .def("place_left", &Rod::place_left, arg("pose"), itself, "The rod begins there.")
      .def("place_right", &Rod::place_right, arg("pose"), itself,
           "Places the right end elsewhere than where the natural shape has it.");
}

}  // namespace

void add_rods(py::module_& m) {
  add_rod_sections(m);
  add_rod_ends(m);
  py::class_<Rod> rod(m, "Rod", "A rod in space, its ends and its dead loads.  Methods return the rod.");
  rod.def(py::init<double, const RodSection&, const RodMaterial&, const RodSupport&, const RodSupport&>(),
          arg("length"), arg("section"), arg("material"), arg("left"), arg("right"), "length [m].")
      .def_property_readonly(
          "length", [](const Rod& self) { return self.length(); }, "[m]")
      .def_property_readonly(
          "thickness", [](const Rod& self) { return self.thickness(); }, "[m]");
  add_rod_loads(rod);
  add_rod_shape(rod);
  m.def(
      "rod_through",
      [](const Numbers& table, const RodSection& section, const RodMaterial& material, const RodSupport& left,
         const RodSupport& right, const Numbers& director) {
        std::vector<VectorOf<double, 3>> points;
        const py::ssize_t n = rows_of(table, 3, "points");
        for (py::ssize_t i = 0; i < n; ++i) points.push_back(place_in_row(table.data(i, 0), 3));
        return rod_through(points, section, material, left, right, vector_of<3>(director, "director"));
      },
      arg("points"), arg("section"), arg("material"), arg("left"), arg("right"),
      arg("director") = std::array<double, 3>{0, 1, 0},
      "A rod that is naturally bent through points (n, 3) [m]: a hook, a ring, a spring.  director: d1 at "
      "the left end.");
}

}  // namespace hapbeam::python
