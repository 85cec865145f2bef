// SPDX-License-Identifier: MIT
// Beams in a plane: section, material, supports, loads, natural shape.
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

std::vector<Vector2<double>> points_of(const Numbers& table) {
  std::vector<Vector2<double>> points;
  const py::ssize_t n = rows_of(table, 2, "points");
  for (py::ssize_t i = 0; i < n; ++i) points.emplace_back(table.data(i, 0)[0], table.data(i, 1)[0]);
  return points;
}

void add_beam_sections(py::module_& m) {
  py::class_<Section>(m, "Section", "Cross-section of a beam.")
      .def(py::init([](double area, double inertia, double thickness) {
             return Section{area, inertia, thickness};
           }),
           arg("area"), arg("inertia"), arg("thickness"),
           "area [m²], inertia: second moment about the bending axis [m⁴], thickness [m] in the plane of "
           "bending.")
      .def_static("rectangle", &Section::rectangle, arg("width"), arg("height"),
                  "width [m] out of the plane of bending, height [m] in it.")
      .def_static("circle", &Section::circle, arg("diameter"), "diameter [m].")
      .def_static("tube", &Section::tube, arg("outer_diameter"), arg("inner_diameter"), "Diameters [m].")
      .def_readonly("area", &Section::area, "[m²]")
      .def_readonly("inertia", &Section::inertia, "[m⁴]")
      .def_readonly("thickness", &Section::thickness, "[m]");
  py::class_<Material>(m, "Material", "Linear elastic material.")
      .def(py::init([](double young) { return Material{young}; }), arg("young"), "Young's modulus [Pa].")
      .def_readonly("young", &Material::young, "[Pa]");
}

void add_beam_loads(py::class_<Beam>& beam) {
  beam.def(
          "weight",
          [](Beam& self, double density, const Numbers& gravity) -> Beam& {
            return self.weight(density, vector_of<2>(gravity, "gravity"));
          },
          arg("density"), arg("gravity"), py::return_value_policy::reference_internal,
          "Its own weight: density [kg/m³], gravity (x, w) [m/s²].")
      .def(
          "add",
          [](Beam& self, double s, double axial, double transverse, double moment) -> Beam& {
            return self.add(PointLoad{s, axial, transverse, moment});
          },
          arg("s"), arg("axial") = 0.0, arg("transverse") = 0.0, arg("moment") = 0.0,
          py::return_value_policy::reference_internal,
          "A dead load at arc position s [m]: forces [N] along x and w, moment [N·m] about theta.")
      .def("transverse", py::overload_cast<double>(&Beam::transverse), arg("load"),
           py::return_value_policy::reference_internal, "A distributed load along w [N/m].")
      .def("transverse", py::overload_cast<DistributedLoad>(&Beam::transverse), arg("load"),
           py::return_value_policy::reference_internal, "The same as a function of arc position [m].")
      .def("axial", py::overload_cast<double>(&Beam::axial), arg("load"),
           py::return_value_policy::reference_internal, "A distributed load along x [N/m].")
      .def("axial", py::overload_cast<DistributedLoad>(&Beam::axial), arg("load"),
           py::return_value_policy::reference_internal, "The same as a function of arc position [m].");
}

void add_beam_shape(py::class_<Beam>& beam) {
  beam.def(
          "naturally",
          [](Beam& self, const std::vector<std::pair<double, double>>& arcs) -> Beam& {
            std::vector<Arc> all;
            for (const auto& [end, curvature] : arcs) all.push_back({end, curvature});
            return self.naturally(std::move(all));
          },
          arg("arcs"), py::return_value_policy::reference_internal,
          "A natural shape of arcs (end, curvature): arc position [m] at which each ends, dtheta/ds [1/m].")
      .def("section", &Beam::section, arg("by_s"), py::return_value_policy::reference_internal,
           "A section that changes along the beam: a function of arc position [m] that returns a Section.")
      .def(
          "sections",
          [](Beam& self,
             const std::vector<std::pair<double, std::function<Section(double)>>>& parts) -> Beam& {
            std::vector<BeamPart> all;
            for (const auto& [end, section] : parts) all.emplace_back(end, section);
            return self.sections(std::move(all));
          },
          arg("parts"), py::return_value_policy::reference_internal,
          "Parts (end, function) with sections of their own: arc position [m] at which each ends.")
      .def("shear", &Beam::shear, arg("stiffness"), py::return_value_policy::reference_internal,
           "Lets a beam of Element.Corotational shear: kappa G A [N].")
      .def(
          "place",
          [](Beam& self, const Numbers& left, const Numbers& right) -> Beam& {
            const auto end = [](const Numbers& numbers, const char* field) {
              const auto place = vector_of<3>(numbers, field);
              return EndPlace{place[0], place[1], place[2]};
            };
            return self.place(end(left, "left"), end(right, "right"));
          },
          arg("left"), arg("right"), py::return_value_policy::reference_internal,
          "Moves the supports by (u, w, theta) [m, m, rad].");
}

}  // namespace

void add_beams(py::module_& m) {
  add_beam_sections(m);
  py::class_<Beam> beam(m, "Beam",
                        "A beam in a plane, its ends and its dead loads.  Methods return the beam.");
  beam.def(py::init<double, const Section&, const Material&, Support, Support>(), arg("length"),
           arg("section"), arg("material"), arg("left"), arg("right"), "length [m].")
      .def(py::init<double, double, double, double, Support, Support>(), arg("length"),
           arg("axial_stiffness"), arg("bending_stiffness"), arg("thickness"), arg("left"), arg("right"),
           "length [m], EA [N], EI [N·m²], thickness [m].")
      .def_property_readonly(
          "length", [](const Beam& self) { return self.length(); }, "[m]")
      .def_property_readonly("axial_stiffness", &Beam::axial_stiffness, "EA [N]")
      .def_property_readonly("bending_stiffness", &Beam::bending_stiffness, "EI [N·m²]")
      .def_property_readonly(
          "thickness", [](const Beam& self) { return self.thickness(); }, "[m]")
      .def_property_readonly("left", &Beam::left, "Support of the left end.")
      .def_property_readonly("right", &Beam::right, "Support of the right end.");
  add_beam_loads(beam);
  add_beam_shape(beam);
  m.def("arch", &arch, arg("span"), arg("rise"), arg("section"), arg("material"), arg("ends"),
        "A circular arch: span [m] from end to end, rise [m] of the middle.");
  m.def(
      "beam_through",
      [](const Numbers& points, const Section& section, const Material& material, Support left,
         Support right) { return beam_through(points_of(points), section, material, left, right); },
      arg("points"), arg("section"), arg("material"), arg("left"), arg("right"),
      "A beam that is naturally bent through points (n, 2) [m].");
  m.def("stretched", &stretched, arg("beam"), arg("by"), "The same beam with its ends moved apart [m].");
  m.def("tensioned", &tensioned, arg("beam"), arg("force"), "The same beam under a normal force [N].");
}

}  // namespace hapbeam::python
