// SPDX-License-Identifier: MIT
// Trained models in files: written after training, read by the program that has the servo loop.
//
//   save_model(model, "bar.json");
//   auto model = load_model<PodModel<>>("bar.json");
//
// A file is two lines of JSON, in UTF-8 and SI:
//
//   {"format":"hapbeam model","version":2,"kind":"pod","scalar":"double","checksum":"crc32:9a3b5c01"}
//   {"units":{"beam.length":"m", …},"beam":{…},"nodes":"chebyshev",…,"grid":{…},…,"shape":{…},"errors":{…}}
//
// The checksum covers every byte after the first line feed. The members of the second line are those of PodModelData
// and GalerkinModelData: one list, visit_model(), serves reader and writer. Reals have enough digits to restore every bit.
// A file gives a whole model or a ModelFileError, which names the file, the field, its value, unit and permitted values.
// Each member must be present, of its type and in its unit, and no other is accepted.
// Offline: allocates and throws.  Needs jansson: link hapbeam::model_file.  hapbeam.hpp does not include this file.
#pragma once

#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include <hapbeam/rom/file/json.hpp>
#include <hapbeam/rom/file/json_reader.hpp>
#include <hapbeam/rom/file/replaced_file.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

namespace hapbeam {

/// The part of a file by which a program chooses the type to load it with.
struct ModelFileInfo {
  int version;
  std::string kind;    ///< pod | galerkin
  std::string scalar;  ///< double | float
  std::string nodes;   ///< Model::Nodes::name(): chebyshev | equispaced
  BeamData<double> beam;
  double s_min, s_max;  ///< [m] of its range
  double depth;         ///< [m]
};

namespace detail {

inline constexpr int model_file_version = 2;

template <typename Scalar>
constexpr const char* scalar_name() noexcept {
  static_assert(std::is_same_v<Scalar, double> || std::is_same_v<Scalar, float>,
                "a model file holds double or float");
  return std::is_same_v<Scalar, double> ? "double" : "float";
}

template <class Fields, class Data>
[[gnu::cold]] void visit_beam_and_range(Fields& f, Data& data) {
  f.real("beam.length", "m", data.beam.length);
  f.real("beam.axial_stiffness", "N", data.beam.axial_stiffness);
  f.real("beam.bending_stiffness", "N·m²", data.beam.bending_stiffness);
  f.real("beam.thickness", "m", data.beam.thickness);
  f.choice("beam.left", data.beam.left, Support::guided);
  f.choice("beam.right", data.beam.right, Support::guided);
  f.real("range.s_min", "m", data.s_min);
  f.real("range.s_max", "m", data.s_max);
  f.real("range.depth", "m", data.depth);
}

template <class Fields, typename Scalar>
[[gnu::cold]] void visit_grid(Fields& f, PodModelData<Scalar>& data) {
  f.flag("grid.symmetric", data.symmetric);
  f.count("grid.positions", data.positions);
  f.count("grid.depths", data.depths);
  f.real("grid.y_low", "1", data.y_low);
  f.real("grid.y_high", "1", data.y_high);
  f.table("potential", "N/m", data.potential);
  f.table("rest", "m", data.rest);
}

template <class Fields, typename Scalar>
[[gnu::cold]] void visit_grid(Fields& f, GalerkinModelData<Scalar>& data) {
  f.count("grid.positions", data.positions);
  f.count("grid.tensions", data.tensions);
  f.real("grid.tension", "N", data.tension);
  f.table("log_stiffness", "ln(N/m)", data.log_stiffness);
}

template <class Fields, typename Scalar>
[[gnu::cold]] void visit_shape(Fields& f, ShapeData<Scalar>& shape) {
  f.count("shape.segments", shape.segments);
  f.count("shape.contact_node", shape.contact_node);
  f.count("shape.modes", shape.modes);
  f.table("shape.basis", "1", shape.basis);
  f.table("shape.coefficients", "1", shape.coefficients);
  f.table("shape.rest", "m, m, rad", shape.rest);
}

template <class Fields>
[[gnu::cold]] void visit_errors(Fields& f, ErrorSummary& errors) {
  f.count("presses", errors.presses);
  f.real("force_median", "1", errors.force_median);
  f.real("force_p95", "1", errors.force_p95);
  f.real("force_max", "1", errors.force_max);
  f.real("shape_median", "1", errors.shape_median);
  f.real("shape_max", "1", errors.shape_max);
}

template <class Fields>
[[gnu::cold]] void visit_region(Fields& f, RegionError& region) {
  f.real("s_min", "m", region.s_min);
  f.real("s_max", "m", region.s_max);
  f.real("depth_min", "m", region.depth_min);
  f.real("depth_max", "m", region.depth_max);
  visit_errors(f, region.errors);
}

template <class Fields, class Data>
[[gnu::cold]] void visit_model(Fields& f, Data& data, const char* nodes) {
  f.units();
  visit_beam_and_range(f, data);
  f.constant("nodes", nodes);
  visit_grid(f, data);
  visit_shape(f, data.shape);
  f.word("errors.reference", data.errors.reference);
  f.real("errors.force_bound", "1", data.errors.force_bound);
  f.real("errors.reference_error", "1", data.errors.reference_error);
  f.object("errors.all", data.errors.all, visit_errors<Fields>);
  f.list("errors.regions", data.errors.regions, visit_region<Fields>);
  f.finish();
}

[[gnu::cold]] inline std::string checksum(const char* bytes, std::size_t size) {
  char text[16];
  std::snprintf(text, sizeof text, "crc32:%08lx", static_cast<unsigned long>(crc32(bytes, size)));
  return text;
}

/// Header and payload.   @param payload  with its line feed
[[gnu::cold]] inline std::string model_file_text(const char* kind, const char* scalar,
                                                 const std::string& payload, const std::string& source) {
  JsonWriter f(source);
  f.constant("format", "hapbeam model");
  f.count("version", model_file_version);
  f.constant("kind", kind);
  f.constant("scalar", scalar);
  f.word("checksum", checksum(payload.data(), payload.size()));
  std::string text = f.text(17) + "\n" + payload;
  check_size(text.size(), source);
  return text;
}

/// The payload, parsed, of a text whose header is valid.   @param info  out, of it the version, kind and scalar
[[gnu::cold]] inline Json parse_model_file(const std::string& text, const std::string& source,
                                           ModelFileInfo& info) {
  check_size(text.size(), source);
  const std::size_t end = text.find('\n');
  if (end == std::string::npos) fail(source, "has one line: must be a header and a model, a line each");
  const Json header = parse_json(text.data(), end, source, 1);
  JsonReader f(header.get(), source);
  f.constant("format", "hapbeam model");
  f.count("version", info.version);
  if (info.version != model_file_version)
    fail(source, "version = %d: must be %d", info.version, model_file_version);
  f.word("kind", info.kind);
  f.word("scalar", info.scalar);
  const char* const payload = text.data() + end + 1;
  const std::size_t size = text.size() - end - 1;
  f.constant("checksum", checksum(payload, size).c_str(),
             ", that of all after the first line: the file is cut off, damaged or changed");
  f.finish();
  return parse_json(payload, size, source, 2);
}

/// The file holds another type of model than the program loads.
[[gnu::cold]] inline void check_type(const char* field, const std::string& found, const char* wanted,
                                     const std::string& source) {
  if (found != wanted)
    fail(source, "%s = \"%.20s\": must be \"%s\" for this type of model", field, found.c_str(), wanted);
}

}  // namespace detail

/// The text of a model's file.   @tparam Model  PodModel | GalerkinModel
/// @throws ModelFileError where an error of its report is not finite
template <class Model>
[[gnu::cold]] std::string write_model(const Model& model, const std::string& source = "model") {
  using Scalar = typename Model::Scalar;
  typename Model::Data data = model.data();
  detail::JsonWriter fields(source);
  detail::visit_model(fields, data, Model::Nodes::name());
  const std::string payload = fields.text(std::numeric_limits<Scalar>::max_digits10) + "\n";
  return detail::model_file_text(data.kind, detail::scalar_name<Scalar>(), payload, source);
}

/// The model in such a text.   @param source  what messages call it   @throws ModelFileError
template <class Model>
[[gnu::cold]] Model read_model(const std::string& text, const std::string& source = "model") {
  typename Model::Data data{};
  ModelFileInfo info{};
  const detail::Json payload = detail::parse_model_file(text, source, info);
  detail::check_type("kind", info.kind, data.kind, source);
  detail::check_type("scalar", info.scalar, detail::scalar_name<typename Model::Scalar>(), source);
  detail::JsonReader fields(payload.get(), source);
  detail::visit_model(fields, data, Model::Nodes::name());
  try {
    Model model(std::move(data));
    detail::check_answers(model);
    return model;
  } catch (const std::invalid_argument& error) {
    detail::fail(source, "%s", error.what());
  }
}

/// Writes a model's file, or throws and leaves the old file: as replaced_file.hpp says.
/// @tparam Model  PodModel | GalerkinModel   @throws ModelFileError
template <class Model>
[[gnu::cold]] void save_model(const Model& model, const std::string& path) {
  const std::string text = write_model(model, path);
  try {
    detail::ReplacedFile file(path);
    file.write(text);
    file.replace();
  } catch (const std::runtime_error& error) {
    throw ModelFileError(error.what());
  }
}

/// Reads a model's file.   @tparam Model  of the kind, scalar and nodes in the file   @throws ModelFileError
template <class Model>
[[gnu::cold]] Model load_model(const std::string& path) {
  return read_model<Model>(detail::read_file(path), path);
}

/// What is in a file.  Its checksum and the members that are returned have been checked; the others are when it is loaded.
/// @throws ModelFileError
[[gnu::cold]] inline ModelFileInfo describe_model_file(const std::string& path) {
  ModelFileInfo info{};
  const detail::Json payload = detail::parse_model_file(detail::read_file(path), path, info);
  detail::JsonReader fields(payload.get(), path);
  fields.units();
  detail::visit_beam_and_range(fields, info);
  fields.word("nodes", info.nodes);
  return info;
}

}  // namespace hapbeam
