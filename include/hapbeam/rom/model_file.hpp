// Trained models in files: written after training, read by the program that has the servo loop.
//
//   save_model(model, "bar.json");
//   auto model = load_model<PodModel<>>("bar.json");
//
// A file is two lines of JSON, in UTF-8 and SI:
//
//   {"format":"hapbeam model","version":1,"kind":"pod","scalar":"double","checksum":"crc32:9a3b5c01"}
//   {"units":{"beam.length":"m", …},"beam":{…},"nodes":"chebyshev","range":{…},"grid":{…},…,"shape":{…},"errors":{…}}
//
// The checksum goes over every byte after the first line feed.  The members of the second line are those of PodModelData
// and GalerkinModelData; visit() below is their list.  Reals have as many digits as bring back every bit.
// A file makes a whole model or a ModelFileError: each member must be there, be of its type and in its unit, and no other
// may; the model's own check has the last word.  The error names the file, the field, its value, unit and what is allowed.
// Offline: allocates and throws.  Needs jansson: link hapbeam::model_file.  hapbeam.hpp does not include this file.
#pragma once

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <hapbeam/rom/checksum.hpp>
#include <hapbeam/rom/galerkin_model.hpp>
#include <hapbeam/rom/json_reader.hpp>
#include <hapbeam/rom/json_writer.hpp>
#include <hapbeam/rom/pod_model.hpp>

namespace hapbeam {

/// What a program must know of a file to choose the type to load it with.
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

inline constexpr int model_file_version = 1;
/// A larger file is refused, unread.  Three million numbers: a servo loop has no time for more.
inline constexpr std::size_t largest_model_file = std::size_t(1) << 26;

template <typename Scalar>
constexpr const char* kind_of(const PodModelData<Scalar>*) noexcept {
  return "pod";
}
template <typename Scalar>
constexpr const char* kind_of(const GalerkinModelData<Scalar>*) noexcept {
  return "galerkin";
}

template <typename Scalar>
constexpr const char* scalar_name() noexcept {
  static_assert(std::is_same_v<Scalar, double> || std::is_same_v<Scalar, float>,
                "a model file holds double or float");
  return std::is_same_v<Scalar, double> ? "double" : "float";
}

template <class Fields, typename Scalar>
void visit_beam(Fields& f, BeamData<Scalar>& beam) {
  f.object("beam", [&] {
    f.real("length", "m", beam.length);
    f.real("axial_stiffness", "N", beam.axial_stiffness);
    f.real("bending_stiffness", "N·m²", beam.bending_stiffness);
    f.real("thickness", "m", beam.thickness);
    for (auto [name, end] : {std::pair{"left", &beam.left}, std::pair{"right", &beam.right}})
      f.choice(name, *end,
               {Support::free, Support::clamped, Support::pinned, Support::roller, Support::guided});
  });
}

template <class Fields, typename Scalar>
void visit_range(Fields& f, Scalar& s_min, Scalar& s_max, Scalar& depth) {
  f.object("range", [&] {
    f.real("s_min", "m", s_min);
    f.real("s_max", "m", s_max);
    f.real("depth", "m", depth);
  });
}

template <class Fields, typename Scalar>
void visit_shape(Fields& f, ShapeData<Scalar>& shape) {
  f.object("shape", [&] {
    f.count("segments", shape.segments);
    f.count("contact_node", shape.contact_node);
    f.count("modes", shape.modes);
    f.table("basis", "1", shape.basis);
    f.table("coefficients", "1", shape.coefficients);
    f.table("rest", "m, m, rad", shape.rest);
  });
}

template <class Fields>
void visit(Fields& f, ErrorSummary& errors) {
  f.count("presses", errors.presses);
  f.real("force_median", "1", errors.force_median);
  f.real("force_p95", "1", errors.force_p95);
  f.real("force_max", "1", errors.force_max);
  f.real("shape_median", "1", errors.shape_median);
  f.real("shape_max", "1", errors.shape_max);
}

template <class Fields>
void visit(Fields& f, ErrorReport& report) {
  f.object("errors", [&] {
    f.word("reference", report.reference);
    f.object("all", [&] { visit(f, report.all); });
    f.list("regions", report.regions, [&](RegionError& region) {
      f.real("s_min", "m", region.s_min);
      f.real("s_max", "m", region.s_max);
      f.real("depth_min", "m", region.depth_min);
      f.real("depth_max", "m", region.depth_max);
      visit(f, region.errors);
    });
  });
}

/// The members of the second line, for reading and for writing.
template <class Fields, typename Scalar>
void visit(Fields& f, PodModelData<Scalar>& data, const char* nodes) {
  f.units();
  visit_beam(f, data.beam);
  f.constant("nodes", nodes);
  visit_range(f, data.s_min, data.s_max, data.depth);
  f.flag("symmetric", data.symmetric);
  f.object("grid", [&] {
    f.count("positions", data.positions);
    f.count("depths", data.depths);
    f.real("y_low", "1", data.y_low);
    f.real("y_high", "1", data.y_high);
  });
  f.table("potential", "N/m", data.potential);
  f.table("rest", "m", data.rest);
  visit_shape(f, data.shape);
  visit(f, data.errors);
  f.finish();
}

template <class Fields, typename Scalar>
void visit(Fields& f, GalerkinModelData<Scalar>& data, const char* nodes) {
  f.units();
  visit_beam(f, data.beam);
  f.constant("nodes", nodes);
  visit_range(f, data.s_min, data.s_max, data.depth);
  f.object("grid", [&] {
    f.count("positions", data.positions);
    f.count("tensions", data.tensions);
    f.real("tension", "N", data.tension);
  });
  f.table("log_stiffness", "ln(N/m)", data.log_stiffness);
  visit_shape(f, data.shape);
  visit(f, data.errors);
  f.finish();
}

inline std::string checksum_of(const std::string& payload) {
  char text[16];
  std::snprintf(text, sizeof text, "crc32:%08lx",
                static_cast<unsigned long>(crc32(payload.data(), payload.size())));
  return text;
}

/// The first line and its line feed.   @param payload  all that follows
inline std::string model_file_header(const std::string& kind, const std::string& scalar,
                                     const std::string& payload) {
  JsonWriter f("header");
  int version = model_file_version;
  f.constant("format", "hapbeam model");
  f.count("version", version);
  f.constant("kind", kind);
  f.constant("scalar", scalar);
  f.constant("checksum", checksum_of(payload));
  return f.text(17) + "\n";
}

inline Json parse_json(const char* text, std::size_t size, const std::string& source, int first_line) {
  json_error_t error;
  Json root(json_loadb(text, size, JSON_REJECT_DUPLICATES, &error));
  if (!root)
    throw ModelFileError(source + ": line " + std::to_string(error.line + first_line - 1) + ", column " +
                         std::to_string(error.column) + ": must be JSON: " + error.text);
  return root;
}

struct ModelFileText {
  std::string kind, scalar;
  Json payload;
};

/// The header, checked, and the payload, parsed.   @param kind, scalar  as wanted, or null: any
inline ModelFileText parse_model_file(const std::string& text, const std::string& source, const char* kind,
                                      const char* scalar) {
  if (text.size() > largest_model_file)
    throw ModelFileError(source + ": size = " + std::to_string(text.size()) + " bytes: must be at most " +
                         std::to_string(largest_model_file));
  const std::size_t end = text.find('\n');
  if (end == std::string::npos)
    throw ModelFileError(source + ": has no second line: must be a header and a model, one line each");
  const Json header = parse_json(text.data(), end, source, 1);
  JsonReader f(header.get(), source);
  f.constant("format", "hapbeam model");
  int version = 0;
  f.count("version", version);
  if (version != model_file_version)
    throw ModelFileError(source + ": version = " + std::to_string(version) + ": must be " +
                         std::to_string(model_file_version));
  ModelFileText file;
  kind ? f.constant("kind", kind) : f.word("kind", file.kind);
  scalar ? f.constant("scalar", scalar) : f.word("scalar", file.scalar);
  const std::string payload = text.substr(end + 1);
  std::string checksum;
  f.word("checksum", checksum);
  f.finish();
  if (checksum != checksum_of(payload))
    throw ModelFileError(source + ": checksum = " + checksum + ": must be " + checksum_of(payload) +
                         ", that of all after the first line: the file is cut off, damaged or changed");
  file.payload = parse_json(payload.data(), payload.size(), source, 2);
  return file;
}

[[noreturn]] inline void reject_file(const std::string& path, const char* what) {
  const std::string why = errno ? std::strerror(errno) : "unknown reason";
  throw ModelFileError(path + ": " + what + ": " + why);
}

struct FileClose {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, FileClose>;

inline std::string read_file(const std::string& path) {
  errno = 0;
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) reject_file(path, "cannot be opened");
  std::string text;
  char part[1 << 14];
  // One byte too many is enough to be refused.
  while (text.size() <= largest_model_file) {
    const std::size_t size = std::fread(part, 1, sizeof part, file.get());
    if (size == 0) break;
    text.append(part, size);
  }
  if (std::ferror(file.get())) reject_file(path, "cannot be read");
  return text;
}

/// All of the text under that name, or nothing new: a file beside it takes its place when it is complete.
inline void write_file(const std::string& path, const std::string& text) {
  errno = 0;
  // A name of its own where two programs save at once.
  std::string temporary;
  File file;
  for (int k = 0; k < 100 && !file; ++k) {
    temporary = path + ".part" + std::to_string(k);
    file.reset(std::fopen(temporary.c_str(), "wbx"));
    if (!file && errno != EEXIST) break;
  }
  if (!file) reject_file(temporary, "cannot be made");
  bool written = std::fwrite(text.data(), 1, text.size(), file.get()) == text.size();
  written = std::fclose(file.release()) == 0 && written;
#ifdef _WIN32
  // Its rename replaces nothing.
  if (written) std::remove(path.c_str());
#endif
  if (written && std::rename(temporary.c_str(), path.c_str()) == 0) return;
  const int why = errno;
  std::remove(temporary.c_str());
  errno = why;
  reject_file(path, "cannot be written");
}

}  // namespace detail

/// The text of a model's file.
/// @tparam Model  PodModel | GalerkinModel   @throws ModelFileError where an error of its report is not finite
template <class Model>
std::string write_model(const Model& model, const std::string& source = "model") {
  typename Model::Data data = model.data();
  detail::JsonWriter fields(source);
  detail::visit(fields, data, Model::Nodes::name());
  const std::string payload = fields.text(std::numeric_limits<typename Model::Scalar>::max_digits10) + "\n";
  const std::string text = detail::model_file_header(detail::kind_of(&data),
                                                     detail::scalar_name<typename Model::Scalar>(), payload) +
                           payload;
  if (text.size() > detail::largest_model_file)
    throw ModelFileError(source + ": size = " + std::to_string(text.size()) + " bytes: must be at most " +
                         std::to_string(detail::largest_model_file));
  return text;
}

/// The model in such a text.   @param source  what messages call it   @throws ModelFileError
template <class Model>
Model read_model(const std::string& text, const std::string& source = "model") {
  typename Model::Data data{};
  const detail::ModelFileText file = detail::parse_model_file(text, source, detail::kind_of(&data),
                                                              detail::scalar_name<typename Model::Scalar>());
  detail::JsonReader fields(file.payload.get(), source);
  detail::visit(fields, data, Model::Nodes::name());
  try {
    return Model(data);
  } catch (const std::invalid_argument& error) {
    throw ModelFileError(source + ": " + error.what());
  }
}

/// Writes a model's file, or throws and leaves what was there before.
/// @tparam Model  PodModel | GalerkinModel   @throws ModelFileError
template <class Model>
void save_model(const Model& model, const std::string& path) {
  detail::write_file(path, write_model(model, path));
}

/// Reads a model's file.   @tparam Model  of the kind, scalar and nodes in the file   @throws ModelFileError
template <class Model>
Model load_model(const std::string& path) {
  return read_model<Model>(detail::read_file(path), path);
}

/// What is in a file.  Its checksum and the members that are returned have been checked; the others are when it is loaded.
/// @throws ModelFileError
inline ModelFileInfo describe_model_file(const std::string& path) {
  const detail::ModelFileText file =
      detail::parse_model_file(detail::read_file(path), path, nullptr, nullptr);
  ModelFileInfo info{detail::model_file_version, file.kind, file.scalar, {}, {}, 0, 0, 0};
  detail::JsonReader fields(file.payload.get(), path);
  fields.units();
  detail::visit_beam(fields, info.beam);
  fields.word("nodes", info.nodes);
  detail::visit_range(fields, info.s_min, info.s_max, info.depth);
  return info;
}

}  // namespace hapbeam
