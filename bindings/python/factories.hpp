// SPDX-License-Identifier: MIT
// Models by their names; each function is compiled in a file of its own.
#pragma once

#include <memory>
#include <string>

#include "any_model.hpp"
#include <hapbeam/beam.hpp>
#include <hapbeam/rod.hpp>
#include <hapbeam/rom/training/training_plan.hpp>

namespace hapbeam::python {

/// Of a FemModel.
enum class Element { Linear, VonKarman, AssumedStrain, Corotational, RoundRod, TwistedRod };

constexpr const char* name(Element element) noexcept {
  switch (element) {
    case Element::Linear: return "Linear";
    case Element::VonKarman: return "VonKarman";
    case Element::AssumedStrain: return "AssumedStrain";
    case Element::Corotational: return "Corotational";
    case Element::RoundRod: return "RoundRod";
    case Element::TwistedRod: return "TwistedRod";
  }
  return "unknown";
}

/// Contacts of a model of several.
inline constexpr int most_in_plane = 4, most_in_space = 2;

using FemPointer = std::unique_ptr<AnyFem>;
using TrainedPointer = std::unique_ptr<AnyTrained>;

/// @throws NotOffered for an element in space, and what FemModel throws
FemPointer model_in_plane(Element element, const Beam& beam, int elements);
FemPointer several_in_plane(const Beam& beam, int elements);
/// As hapbeam::elements_for.   @throws NotOffered for an element in space
int elements_in_plane(Element element, const Beam& beam, double depth, double error);
/// @param element  RoundRod, else TwistedRod is taken
int elements_in_space(Element element, const Rod& rod, double depth, double error);
FemPointer model_in_space(Element element, const Rod& rod, int elements);
FemPointer several_in_space(Element element, const Rod& rod, int elements);

/// Trained, and validated by presses that it was not trained with.   @param elements  of the full model
TrainedPointer train_pod(const Beam& beam, const TrainingPlan& plan, int elements);
TrainedPointer train_galerkin(const Beam& beam, const TrainingPlan& plan, int elements);

/// Whether the module was built with them.
extern const bool has_model_files;
/// @throws std::invalid_argument for what a file has wrong, and std::runtime_error where the module was built without them
TrainedPointer load_model(const std::string& path);

}  // namespace hapbeam::python
