// SPDX-License-Identifier: MIT
// One avatar: on a beam, on a rod, on an array of beams.
#include <cstdint>
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

/// As many ticks, one row each.
struct Curve {
  int dimension;
  py::array_t<double> force, friction, s;
  py::array_t<std::int8_t> status;
  py::array_t<bool> pressing;

  Curve(py::ssize_t n, int d)
      : dimension(d),
        force({n, py::ssize_t(d)}),
        friction({n, py::ssize_t(d)}),
        s(n),
        status(n),
        pressing(n) {}
};

Curve ticks(AnyTouch& touch, const Numbers& positions, const py::object& shafts) {
  const int d = touch.dimension();
  const py::ssize_t n = rows_of(positions, d, "positions");
  const Numbers along = shafts.is_none() ? Numbers() : shafts.cast<Numbers>();
  const bool capsules = !shafts.is_none();
  if (capsules && (d == 2 || rows_of(along, 3, "shafts") != n))
    reject_shape("shafts", along, "as many as there are positions, in space");
  Curve curve(n, d);
  double *const force = curve.force.mutable_data(), *const friction = curve.friction.mutable_data(),
                *const s = curve.s.mutable_data();
  std::int8_t* const status = curve.status.mutable_data();
  bool* const pressing = curve.pressing.mutable_data();
  const double *const at = positions.data(), *const way = capsules ? along.data() : nullptr;
  unlocked(*touch.mutex, [&] {
    for (py::ssize_t i = 0; i < n; ++i) {
      const Felt felt =
          touch.tick(place_in_row(at + i * d, d), way ? place_in_row(way + i * d, d) : Place(Place::Zero()));
      for (int k = 0; k < d; ++k)
        force[i * d + k] = felt.touch.force[k], friction[i * d + k] = felt.touch.friction[k];
      s[i] = felt.touch.press.s;
      status[i] = static_cast<std::int8_t>(felt.touch.status);
      pressing[i] = felt.touch.pressing;
    }
  });
  return curve;
}

void add_touch_results(py::module_& m) {
  // A vector of the touch's own dimension.
  const auto vector = [](auto get) {
    return [get](const Felt& felt) { return array_of(Place(get(felt.touch)), felt.dimension); };
  };
  py::class_<Felt>(m, "TouchResult", "What a tick of a Touch says.")
      .def_property_readonly("force", vector([](const auto& t) { return t.force; }),
                             "[N] on the hand, in the plane (x, w); always finite")
      .def_property_readonly("friction", vector([](const auto& t) { return t.friction; }),
                             "[N] the tangential part of the force")
      .def_property_readonly("point", vector([](const auto& t) { return t.contact.point; }),
                             "[m] of the surface, nearest to the avatar before the press")
      .def_property_readonly("normal", vector([](const auto& t) { return t.contact.normal; }),
                             "Unit, out of the beam")
      .def_property_readonly("status", [](const Felt& f) { return f.touch.status; })
      .def_property_readonly(
          "pressing", [](const Felt& f) { return f.touch.pressing; }, "The hand holds the beam.")
      .def_property_readonly(
          "sliding", [](const Felt& f) { return f.touch.sliding; },
          "With friction: the contact slides, else it sticks.")
      .def_property_readonly(
          "dissipated", [](const Felt& f) { return f.touch.dissipated; },
          "[J] by friction, since the touch began")
      .def_property_readonly(
          "depth", [](const Felt& f) { return f.touch.contact.depth; },
          "[m] penetration before the press; negative: the gap")
      .def_property_readonly(
          "s", [](const Felt& f) { return f.touch.press.s; }, "[m] arc position pressed")
      .def_property_readonly(
          "d", [](const Felt& f) { return f.touch.press.d; }, "[m] displacement asked of the model")
      .def_property_readonly(
          "beam", [](const Felt& f) { return f.beam; }, "Of an array: the beam that pushes hardest; else -1.")
      .def_property_readonly(
          "complete", [](const Felt& f) { return f.complete; },
          "Of an array: False where more beams were met than taken.");
  py::class_<Curve>(m, "ForceCurve", "What many ticks of a Touch say: arrays with a row for each.")
      .def_readonly("force", &Curve::force, "[N] on the hand, (n, 2) or (n, 3)")
      .def_readonly("friction", &Curve::friction, "[N] its tangential part")
      .def_readonly("status", &Curve::status, "Status as int8, (n,)")
      .def_readonly("pressing", &Curve::pressing, "bool, (n,)")
      .def_readonly("s", &Curve::s, "[m] arc position pressed, (n,)");
}

void add_touch_class(py::module_& m) {
  py::class_<AnyTouch>(m, "Touch", "One round avatar on a model, which it alone presses.")
      .def(py::init([](AnyModel& model, double radius, const Friction& friction) {
             auto touch = locked(model.mutex, [&] { return model.touch(radius, friction); });
             touch->mutex = &model.mutex;
             return touch;
           }),
           arg("model"), arg("avatar_radius"), arg("friction") = Friction(), py::keep_alive<1, 2>(),
           "avatar_radius [m].")
      .def(
          "tick",
          [](AnyTouch& touch, const Numbers& position, const py::object& shaft) {
            const int d = touch.dimension();
            const Place at = place_of(position, d, "position");
            if (!shaft.is_none() && d == 2) throw NotOffered("shaft: of a touch in space");
            const Place way =
                shaft.is_none() ? Place(Place::Zero()) : Place(vector_of<3>(shaft.cast<Numbers>(), "shaft"));
            return locked(*touch.mutex, [&] { return touch.tick(at, way); });
          },
          arg("position"), arg("shaft") = py::none(),
          "One tick: position [m] of the avatar's centre.  In space a capsule has its tip there, and a shaft "
          "[m] from there to the other end of its axis.")
      .def(
          "ticks", &ticks, arg("positions"), arg("shafts") = py::none(),
          "One tick for each row of positions (n, 2) or (n, 3), in their order.  Other threads of Python run "
          "meanwhile.")
      .def(
          "reset", [](AnyTouch& touch) { locked(*touch.mutex, [&] { return touch.reset(), true; }); },
          "Releases the beam, and forgets where the hand was.")
      .def(
          "soften",
          [](AnyTouch& touch, double stiffness, double damping) {
            detail::positive("stiffness", stiffness, "N/m"), detail::not_negative("damping", damping, "N/m");
            locked(*touch.mutex, [&] { return touch.soften(stiffness, damping), true; });
          },
          arg("stiffness"), arg("damping") = 0.0,
          "With friction: the avatar's skin yields along the surface, by a stiffness [N/m] and a damper "
          "[N/m], "
          "N·s/m over the time of a tick.")
      .def_property_readonly("pressing", &AnyTouch::pressing)
      .def_property_readonly("resting", &AnyTouch::resting);
}

AnyArrayTouch& checked(AnyArrayTouch& touch, int beam) {
  if (beam < 0 || beam >= touch.size()) detail::reject("beam", beam, "", "the index of a beam of the array");
  return touch;
}

void add_arrays(py::module_& m) {
  py::class_<AnyArray>(m, "BeamArray", "Many beams in one plane: a brush, hair, a harp.")
      .def(py::init([](const std::vector<AnyFem*>& kinds, const Numbers& places,
                       const std::vector<int>& kind_of, int most_touched) {
             const py::ssize_t n = rows_of(places, 3, "places");
             if (!kind_of.empty() && static_cast<py::ssize_t>(kind_of.size()) != n)
               throw std::invalid_argument("kind_of: must have as many numbers as there are places");
             if (kinds.empty()) throw std::invalid_argument("kinds: must be one or more");
             std::vector<BeamPlace> all;
             for (py::ssize_t i = 0; i < n; ++i) {
               const double* const row = places.data(i, 0);
               all.push_back(
                   {{row[0], row[1]}, row[2], kind_of.empty() ? 0 : kind_of[static_cast<std::size_t>(i)]});
             }
             const std::vector<const AnyFem*> models(kinds.begin(), kinds.end());
             return kinds.front()->array(models, all, most_touched);
           }),
           arg("kinds"), arg("places"), arg("kind_of") = std::vector<int>{}, arg("most_touched") = 64,
           "kinds: models, which are copied.  places (n, 3): x, y [m] of each left end, angle [rad].  "
           "kind_of: "
           "the index of each beam's model.  most_touched: by the hand at once.")
      .def("__len__", &AnyArray::size);
  py::class_<AnyArrayTouch, AnyTouch>(m, "ArrayTouch", "One round avatar on an array of beams.")
      .def(py::init([](AnyArray& array, double radius) {
             auto touch = array.touch(radius);
             touch->mutex = &array.mutex;
             return touch;
           }),
           arg("array"), arg("avatar_radius"), py::keep_alive<1, 2>(), "avatar_radius [m].")
      .def(
          "touches",
          [](AnyArrayTouch& touch) {
            py::list all;
            for (const TouchedBeam& touched : touch.touches())
              all.append(py::make_tuple(touched.beam, array_of(touched.force, 2)));
            return all;
          },
          "The beams that were pressed in the last tick: (beam, force [N] on the hand).")
      .def(
          "shape",
          [](AnyArrayTouch& touch, int beam, const py::object& points) {
            checked(touch, beam);
            return places_of({nullptr, 0}, 2, touch.length(beam),
                             points.is_none() ? py::object(py::int_(33)) : points,
                             [&](double s) { return touch.position(beam, s); });
          },
          arg("beam"), arg("points") = py::none(),
          "Places [m] of a beam in the array's axes, a new array (n, 2), as Model.shape(); 33 points by "
          "default.");
}

}  // namespace

void add_touch(py::module_& m) {
  py::class_<Friction>(m, "Friction", "Coulomb friction between avatar and beam.")
      .def(py::init<double, double>(), arg("sticking"), arg("sliding"), "Coefficients, 0 to 2.")
      .def(py::init<double>(), arg("both") = 0.0, "Sticking and sliding alike.")
      .def_readonly("sticking", &Friction::sticking)
      .def_readonly("sliding", &Friction::sliding);
  py::implicitly_convertible<double, Friction>();
  py::implicitly_convertible<int, Friction>();
  add_touch_results(m);
  add_touch_class(m);
  add_arrays(m);
}

}  // namespace hapbeam::python
