// SPDX-License-Identifier: MIT
// Models: what takes a press or a push, and how it then lies.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "enums.hpp"
#include "locked.hpp"
#include "module.hpp"

namespace hapbeam::python {
namespace {

using py::arg;

FemPointer beam_model(const Beam& beam, int elements, Element element, int contacts) {
  if (contacts < 1 || contacts > most_in_plane) detail::reject("contacts", contacts, "", "1 to 4");
  if (contacts == 1) return model_in_plane(element, beam, elements);
  if (element != Element::Corotational)
    throw NotOffered("contacts > 1: of Element.Corotational, RoundRod or TwistedRod");
  return several_in_plane(beam, elements);
}
FemPointer rod_model(const Rod& rod, int elements, Element element, int contacts) {
  if (element != Element::RoundRod && element != Element::TwistedRod)
    throw NotOffered("a Rod takes Element.RoundRod or TwistedRod");
  if (contacts < 1 || contacts > most_in_space) detail::reject("contacts", contacts, "", "1 or 2");
  return contacts == 1 ? model_in_space(element, rod, elements) : several_in_space(element, rod, elements);
}

int elements_of_rod(const Rod& rod, double depth, double error, Element element) {
  if (element != Element::RoundRod && element != Element::TwistedRod)
    throw NotOffered("a Rod takes Element.RoundRod or TwistedRod");
  return elements_in_space(element, rod, depth, error);
}

/// Presses one after the other, without Python's lock.
py::tuple presses(AnyModel& model, const Numbers& s, const Numbers& d) {
  if (s.ndim() > 1 || d.ndim() > 1 || (s.ndim() == 1 && d.ndim() == 1 && s.shape(0) != d.shape(0)))
    reject_shape("s and d", d, "numbers, or arrays of the same length");
  const py::ssize_t n = s.ndim() == 1 ? s.shape(0) : d.ndim() == 1 ? d.shape(0) : 1;
  py::array_t<double> forces(n);
  py::array_t<std::int8_t> statuses(n);
  const double *const at = s.data(), *const depth = d.data();
  double* const force = forces.mutable_data();
  std::int8_t* const status = statuses.mutable_data();
  unlocked(model.mutex, [&, many_s = s.ndim() == 1, many_d = d.ndim() == 1] {
    for (py::ssize_t i = 0; i < n; ++i) {
      const Response<double> answer = model.press({at[many_s ? i : 0], depth[many_d ? i : 0]});
      force[i] = answer.force, status[i] = static_cast<std::int8_t>(answer.status);
    }
  });
  return py::make_tuple(forces, statuses);
}

/// A structured array of the shape of s, with a field for each of the forces.
py::array internal_forces(AnyFem& model, const Numbers& s) {
  const std::vector<std::string> names = internal_force_names(model.dimension());
  py::list names_list, formats, offsets;
  for (std::size_t k = 0; k < names.size(); ++k) {
    names_list.append(names[k]), formats.append("f8"), offsets.append(k * sizeof(double));
  }
  const auto fields = static_cast<py::ssize_t>(names.size());
  py::array all(py::dtype(names_list, formats, offsets, fields * py::ssize_t(sizeof(double))),
                std::vector<py::ssize_t>(s.shape(), s.shape() + s.ndim()));
  auto* const out = static_cast<double*>(all.mutable_data());
  return locked(model.mutex, [&] {
    for (py::ssize_t i = 0; i < s.size(); ++i) {
      if (!(s.data()[i] >= 0 && s.data()[i] <= model.length()))
        detail::reject("s", s.data()[i], "m", "on the beam, 0 to its length");
      model.internal_forces(s.data()[i], out + i * fields);
    }
    return all;
  });
}

void add_answers(py::module_& m) {
  py::class_<Response<double>>(m, "Response", "Of a press or a push.")
      .def_readonly("force", &Response<double>::force,
                    "[N] on the beam along the press; the hand feels -force.")
      .def_readonly("status", &Response<double>::status, "Whether the force belongs to the request.");
  py::class_<HeldEnd<double>>(m, "HeldEnd", "Of an end of a rod that is held elsewhere.")
      .def_property_readonly(
          "force", [](const HeldEnd<double>& h) { return array_of(h.force); }, "[N] on the rod")
      .def_property_readonly(
          "moment", [](const HeldEnd<double>& h) { return array_of(h.moment); },
          "[N·m] on the rod, about the end")
      .def_readonly("status", &HeldEnd<double>::status);
  py::class_<Solved>(m, "SolveReport", "How the search for an equilibrium ended.")
      .def_readonly("status", &Solved::status)
      .def_readonly("solves", &Solved::solves, "Linear solves.")
      .def_readonly("steps", &Solved::steps, "Load steps that converged.")
      .def_readonly("error", &Solved::error, "Estimated relative error of the force.");
  py::class_<PeakStrain<double>>(m, "PeakStrain", "The largest strain at the surface.")
      .def_readonly("strain", &PeakStrain<double>::strain, "[-]")
      .def_readonly("s", &PeakStrain<double>::s, "[m] where");
  py::class_<Range<double>>(m, "Range", "Where a model answers a press with Status.ok.")
      .def_readonly("s_min", &Range<double>::s_min, "[m]")
      .def_readonly("s_max", &Range<double>::s_max, "[m]")
      .def_readonly("depth", &Range<double>::depth, "[m] largest |d| anywhere")
      .def("depth_at", &Range<double>::depth_at, arg("s"), "[m] largest |d| at arc position s [m].");
}

void add_model(py::module_& m) {
  py::class_<AnyModel>(m, "Model", "What all models have.")
      .def_property_readonly("kind", &AnyModel::kind, "Its elements, or PodModel or GalerkinModel.")
      .def_property_readonly("dimension", &AnyModel::dimension, "Of the space in which it bends: 2 or 3.")
      .def_property_readonly("length", &AnyModel::length, "[m] of the unloaded beam.")
      .def_property_readonly("thickness", &AnyModel::thickness, "[m] that an avatar touches.")
      .def(
          "press",
          [](AnyModel& model, double s, double d) {
            return locked(model.mutex, [&] { return model.press({s, d}); });
          },
          arg("s"), arg("d"),
          "Prescribes the transverse displacement d [m] at arc position s [m], in the plane.")
      .def("presses", &presses, arg("s"), arg("d"),
           "The same one after the other, for arrays: forces [N] and statuses (int8).  Other threads of "
           "Python run meanwhile.")
      .def("range", &AnyModel::range)
      .def(
          "reset", [](AnyModel& model) { locked(model.mutex, [&] { return model.reset(), true; }); },
          "Back to the shape at rest.")
      .def(
          "nodes",
          [](const py::object& self) {
            auto& model = self.cast<AnyModel&>();
            return locked(model.mutex, [&] { return view_of(model.nodes(), model.dimension(), self); });
          },
          "The nodes of the shape, in the memory of the model: a read-only array, without a copy, whose "
          "numbers change with the next call.  Fields in the plane: s, u, w [m], theta [rad]; in space: s, r "
          "[m], tangent, director.")
      .def(
          "shape",
          [](AnyModel& model, const py::object& points) {
            return locked(model.mutex, [&] {
              return places_of(model.nodes(), model.dimension(), model.length(), points,
                               [&](double s) { return model.position(s); });
            });
          },
          arg("points") = py::none(),
          "Places [m] of the centreline, a new array (n, 2) or (n, 3): of its nodes, of so many points, or "
          "of "
          "the points at these arc positions [m].");
}

void add_fem(py::module_& m) {
  py::class_<AnyFem, AnyModel>(m, "FemModel", "Finite elements of a Beam or a Rod.")
      .def(py::init(&beam_model), arg("beam"), arg("elements"), arg("element") = Element::VonKarman,
           arg("contacts") = 1,
           "contacts: how many bodies may touch it at once, at most 4; more than 1 of Element.Corotational.")
      .def(py::init(&rod_model), arg("rod"), arg("elements"), arg("element") = Element::TwistedRod,
           arg("contacts") = 1, "contacts: 1 or 2.")
      .def_property_readonly("elements", &AnyFem::elements)
      .def_property_readonly("contacts", &AnyFem::contacts, "How many bodies may touch it at once.")
      .def(
          "push",
          [](AnyFem& model, double s, double d, const Numbers& normal) {
            const Place n = place_of(normal, model.dimension(), "normal");
            return locked(model.mutex, [&] { return model.push({s, d, n}); });
          },
          arg("s"), arg("d"), arg("normal"),
          "Prescribes the displacement d [m] along a unit vector at arc position s [m]; of a rod d is that "
          "of "
          "its place.  Of rods and of Element.Corotational.")
      .def(
          "hold",
          [](AnyFem& model, RodSide side, const RodPose& pose) {
            RodPose unit = pose;
            if (!unit.make_valid())
              throw std::invalid_argument("pose: must be finite, its director across along");
            return locked(model.mutex, [&] { return model.hold(side, unit); });
          },
          arg("side"), arg("pose"), "Holds a clamped end of a rod elsewhere.")
      .def(
          "release", [](AnyFem& model) { return locked(model.mutex, [&] { return model.release(); }); },
          "Lets go: the beam falls to where it is at rest.")
      .def("internal_forces", &internal_forces, arg("s"),
           "What the sections at arc positions s [m] carry, by fields: normal, shear [N], moment [N·m], "
           "axial_strain, surface_strain; of a rod normal, shear1, shear2, moment1, moment2, torsion and the "
           "same strains.")
      .def(
          "peak_strain",
          [](AnyFem& model) { return locked(model.mutex, [&] { return model.peak_strain(); }); },
          "The largest strain at the surface, and where it is.")
      .def(
          "strain_energy",
          [](AnyFem& model) { return locked(model.mutex, [&] { return model.strain_energy(); }); },
          "Of the present shape [J].")
      .def(
          "force_error",
          [](AnyFem& model) { return locked(model.mutex, [&] { return model.force_error(); }); },
          "Bound [N] on what the mesh leaves in the force of the last answer.  The first call makes a mesh "
          "of "
          "four times the elements.")
      .def("rest", &AnyFem::rest, "How the search for the shape under the dead loads ended.")
      .def(
          "report", [](AnyFem& model) { return locked(model.mutex, [&] { return model.report(); }); },
          "How the last press or push ended.");
}

void add_elements_for(py::module_& m) {
  const char* const doc =
      "The fewest elements, doubled from four on, whose force_error() is within an error of the force "
      "(relative), "
      "pressed to a depth [m] at seven places.  ValueError where 256 are not enough.";
  m.def(
      "elements_for",
      [](const Beam& beam, double depth, double error, Element element) {
        return elements_in_plane(element, beam, depth, error);
      },
      arg("beam"), arg("depth"), arg("error"), arg("element") = Element::VonKarman,
      py::call_guard<py::gil_scoped_release>(), doc);
  m.def("elements_for", &elements_of_rod, arg("rod"), arg("depth"), arg("error"),
        arg("element") = Element::TwistedRod, py::call_guard<py::gil_scoped_release>(), doc);
}

void add_trained(py::module_& m) {
  py::class_<ErrorReport>(m, "ErrorReport", "Errors of presses that a model was not trained with.")
      .def_readonly("force_bound", &ErrorReport::force_bound, "Bound on the relative error of the force.")
      .def_readonly("reference_error", &ErrorReport::reference_error, "Of the full model's force.")
      .def_property_readonly("force_median", [](const ErrorReport& r) { return r.all.force_median; })
      .def_property_readonly("force_max", [](const ErrorReport& r) { return r.all.force_max; })
      .def_property_readonly("shape_max", [](const ErrorReport& r) { return r.all.shape_max; });
  py::class_<AnyTrained, AnyModel>(m, "TrainedModel", "A PodModel or a GalerkinModel, as its kind says.")
      .def_property_readonly("errors", &AnyTrained::errors, py::return_value_policy::copy);
  py::class_<TrainingPlan>(m, "TrainingPlan", "The presses with which a model is trained.")
      .def_static("anywhere", &TrainingPlan::anywhere, arg("beam"), arg("depth"), arg("positions") = 16,
                  arg("depths") = 12, "From 5 to 95 % of the span, up to a depth [m].")
      .def_static("at", &TrainingPlan::at, arg("s"), arg("depth"), arg("depths") = 14,
                  "At one arc position [m], up to a depth [m].")
      .def_readwrite("s_min", &TrainingPlan::s_min, "[m]")
      .def_readwrite("s_max", &TrainingPlan::s_max, "[m]")
      .def_readwrite("symmetric", &TrainingPlan::symmetric,
                     "Both ways alike; False for a beam under dead loads.");
  const auto trained = [&m](const char* name, TrainedPointer (*train)(const Beam&, const TrainingPlan&, int),
                            const char* doc) {
    m.def(name, train, arg("beam"), arg("plan"), arg("elements") = 256,
          py::call_guard<py::gil_scoped_release>(), doc);
  };
  trained("train_pod", &train_pod, "A PodModel, trained by a full model of so many elements, and validated.");
  trained("train_galerkin", &train_galerkin, "A GalerkinModel, trained and validated likewise.");
  m.def("load_model", &load_model, arg("path"), "The trained model in a file.");
  m.def(
      "save_model", [](const AnyTrained& model, const std::string& path) { model.save(path); }, arg("model"),
      arg("path"), "Keeps a trained model in a file.");
}

}  // namespace

void add_models(py::module_& m) {
  add_answers(m);
  add_model(m);
  add_fem(m);
  add_elements_for(m);
  add_trained(m);
}

}  // namespace hapbeam::python
