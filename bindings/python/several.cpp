// SPDX-License-Identifier: MIT
// Several avatars and props on one model.
#include <memory>
#include <pybind11/stl.h>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "enums.hpp"
#include "locked.hpp"
#include "module.hpp"

namespace hapbeam::python {
namespace {

using py::arg;

/// A place of a FeltSeveral, with its dimension.
struct FeltPlace {
  int dimension;
  TouchPlace<double, 3> place;
};

/// The sum over the places of one body.
template <class Get>
py::array_t<double> sum(const FeltSeveral& felt, int body, const Get& get) {
  Place sum = Place::Zero();
  for (const auto& place : felt.places)
    if (place.body == body) sum += get(place);
  return array_of(sum, felt.dimension);
}

template <int D>
void add_prop(py::module_& m, const char* name, const char* doc) {
  using Body = Prop<D>;
  py::class_<Body> prop(m, name, doc);
  prop.def_static(
          "peg",
          [](const Numbers& centre, double radius) {
            return Body::peg(vector_of<D>(centre, "centre"), radius);
          },
          arg("centre"), arg("radius"), "A rigid disc, in space a sphere: centre, radius [m].")
      .def_static(
          "wall",
          [](const Numbers& point, const Numbers& normal) {
            return Body::wall(vector_of<D>(point, "point"), vector_of<D>(normal, "normal"));
          },
          arg("point"), arg("normal"), "A rigid wall: a point on it [m], a direction out of it.")
      .def_static(
          "stop",
          [](double s, double d, const Numbers& normal) {
            return Body::stop(s, d, vector_of<D>(normal, "normal"));
          },
          arg("s"), arg("d"), arg("normal"),
          "The place s [m] of the beam goes no farther than d [m] along a direction.")
      .def_static(
          "support",
          [](double s, double d, const Numbers& normal) {
            return Body::support(s, d, vector_of<D>(normal, "normal"));
          },
          arg("s"), arg("d"), arg("normal"), "The place s [m] of the beam stays at d [m] along a direction.")
      .def("rough", &Body::rough, arg("friction"), "The same peg, bar or wall with friction.");
  if constexpr (D == 3)
    prop.def_static(
        "bar",
        [](const Numbers& from, const Numbers& to, double radius) {
          return Body::bar(vector_of<3>(from, "start"), vector_of<3>(to, "end"), radius);
        },
        arg("start"), arg("end"), arg("radius"), "A rigid round bar: ends of its axis, radius [m].");
}

void add_several_results(py::module_& m) {
  const auto vector = [](auto member) {
    return [member](const FeltPlace& felt) { return array_of(felt.place.*member, felt.dimension); };
  };
  using Touched = TouchPlace<double, 3>;
  py::class_<FeltPlace>(m, "TouchPlace", "What becomes of one possible contact in a tick.")
      .def_property_readonly(
          "body", [](const FeltPlace& f) { return f.place.body; },
          "Avatars in their order, then props in theirs.")
      .def_property_readonly("touching", [](const FeltPlace& f) { return f.place.touching; })
      .def_property_readonly("status", [](const FeltPlace& f) { return f.place.status; })
      .def_property_readonly(
          "s", [](const FeltPlace& f) { return f.place.s; }, "[m] arc position")
      .def_property_readonly(
          "depth", [](const FeltPlace& f) { return f.place.depth; },
          "[m] before this tick; negative: the gap")
      .def_property_readonly("sliding", [](const FeltPlace& f) { return f.place.sliding; })
      .def_property_readonly(
          "dissipated", [](const FeltPlace& f) { return f.place.dissipated; }, "[J]")
      .def_property_readonly("point", vector(&Touched::point), "[m] of the centreline")
      .def_property_readonly("normal", vector(&Touched::normal), "Unit, out of the beam to the body")
      .def_property_readonly("force", vector(&Touched::force), "[N] on the body; always finite")
      .def_property_readonly("friction", vector(&Touched::friction), "[N] its tangential part");
  py::class_<FeltSeveral>(m, "TouchSeveralResult", "What a tick of a TouchSeveral says.")
      .def_readonly("status", &FeltSeveral::status, "The worst of all places.")
      .def_property_readonly(
          "places",
          [](const FeltSeveral& felt) {
            std::vector<FeltPlace> all;
            for (const auto& place : felt.places) all.push_back({felt.dimension, place});
            return all;
          },
          "Each possible contact.")
      .def(
          "force",
          [](const FeltSeveral& felt, int body) { return sum(felt, body, [](auto& p) { return p.force; }); },
          arg("body"), "[N] on an avatar or a prop.")
      .def(
          "friction",
          [](const FeltSeveral& felt, int body) {
            return sum(felt, body, [](auto& p) { return p.friction; });
          },
          arg("body"), "[N] its tangential part.");
}

std::unique_ptr<AnyTouchSeveral> touch_several(AnyFem& model, const std::vector<RoundAvatar>& avatars,
                                               const py::list& props) {
  Bodies bodies{avatars, {}, {}};
  for (const py::handle& prop : props) {
    if (py::isinstance<Prop<2>>(prop)) bodies.in_plane.push_back(prop.cast<Prop<2>>());
    else bodies.in_space.push_back(prop.cast<Prop<3>>());
  }
  auto touch = locked(model.mutex, [&] { return model.touch_several(bodies); });
  touch->mutex = &model.mutex;
  return touch;
}

}  // namespace

void add_several(py::module_& m) {
  add_prop<2>(m, "Prop", "What stands beside a beam in the plane and is moved by nobody.");
  add_prop<3>(m, "RodProp", "What stands beside a rod and is moved by nobody.");
  py::class_<RoundAvatar>(m, "RoundAvatar", "A round avatar that a hand moves.")
      .def(py::init<double, int, const Friction&>(), arg("radius"), arg("touches") = 1,
           arg("friction") = Friction(), "radius [m]; touches: at so many places at most.");
  py::implicitly_convertible<double, RoundAvatar>();
  add_several_results(m);
  py::class_<AnyTouchSeveral>(m, "TouchSeveral",
                              "Several avatars and props on a FemModel with room for their contacts.")
      .def(py::init(&touch_several), arg("model"), arg("avatars"), arg("props") = py::list(),
           py::keep_alive<1, 2>(), "avatars: RoundAvatar, or radii [m].  props: Prop, of a rod RodProp.")
      .def(
          "tick",
          [](AnyTouchSeveral& touch, const Numbers& positions) {
            const int d = touch.dimension();
            const py::ssize_t n = rows_of(positions, d, "positions");
            std::vector<Place> places;
            for (py::ssize_t i = 0; i < n; ++i) places.push_back(place_in_row(positions.data(i, 0), d));
            return locked(*touch.mutex, [&] { return touch.tick(places); });
          },
          arg("positions"), "One tick: the centre [m] of each avatar, a row each.")
      .def(
          "reset", [](AnyTouchSeveral& touch) { locked(*touch.mutex, [&] { return touch.reset(), true; }); },
          "Lets go of the beam, and forgets where the hands were.")
      .def(
          "soften",
          [](AnyTouchSeveral& touch, int avatar, double stiffness, double damping) {
            detail::positive("stiffness", stiffness, "N/m"), detail::not_negative("damping", damping, "N/m");
            locked(*touch.mutex, [&] { return touch.soften(avatar, stiffness, damping), true; });
          },
          arg("avatar"), arg("stiffness"), arg("damping") = 0.0, "As Touch.soften(), of one avatar.");
}

}  // namespace hapbeam::python
