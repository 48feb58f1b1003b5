// A thin C++17 face of morula.h: handles that free themselves, std::vector and
// std::array instead of pointers, exceptions instead of statuses. Everything is
// inline; link against the same library as for C.
//
// Arrays are handed in as views: of a std::vector, std::array, std::span, C array, pointer and
// length, or a list in braces. Nothing is allocated beyond what is given back, but small arrays of
// pointers by the calls for many bodies at once, and scratch by labels() and from_silhouettes().
//
// Options and results are the structs of morula.h: morula::ClumpOptions is
// morula_clump_options filled with the defaults, and so on.
#ifndef MORULA_HPP
#define MORULA_HPP

#include "morula.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace morula {

/// A call failed: the status and the library's sentence.
class Error : public std::runtime_error {
 public:
  Error(std::int32_t status, const char *message) : std::runtime_error(message), status_(status) {}
  /// One of MORULA_STATUS_*.
  std::int32_t status() const noexcept { return status_; }
  /// Its name, for instance "NOT_FINITE".
  const char *name() const noexcept { return morula_status_name(status_); }

 private:
  std::int32_t status_;
};

/// Throws Error unless `status` is MORULA_STATUS_OK.
inline void check(std::int32_t status) {
  if (status != MORULA_STATUS_OK) throw Error(status, morula_last_error_message());
}

/// The version of the library: 1000000 major + 1000 minor + patch, and as text.
inline std::uint32_t version() noexcept { return morula_version(); }
inline const char *version_string() noexcept { return morula_version_string(); }
/// The word for a number of MORULA_STOPPED_*, of MORULA_MASSES_*, of MORULA_WARNING_*.
inline const char *stopped_name(std::int32_t stopped) noexcept {
  return morula_stopped_name(stopped);
}
inline const char *masses_name(std::int32_t status) noexcept {
  return morula_masses_status_name(status);
}
inline const char *warning_name(std::int32_t warning) noexcept {
  return morula_warning_name(warning);
}

/// A component sphere.
struct Sphere {
  std::array<double, 3> center;
  double radius;
};
// The library reads and writes arrays of them in place.
static_assert(sizeof(Sphere) == 4 * sizeof(double) && std::is_standard_layout_v<Sphere>);

/// A limit that a clump meets: one of MORULA_WARNING_*, the figure found, the bound that it misses.
struct Warning {
  std::int32_t code;
  double figure, bound;
  std::string text;
};

/// Elements one after another, which something else holds: valid for the time of a call. A
/// std::span converts to it, and it to one.
template <class T>
class View {
 public:
  constexpr View() noexcept = default;
  constexpr View(const T *data, std::size_t size) noexcept : data_(data), size_(size) {}
  /// Of anything contiguous that holds T.
  template <class C, class = std::enable_if_t<std::is_convertible_v<
                         std::remove_pointer_t<decltype(std::data(std::declval<const C &>()))> (*)[],
                         const T (*)[]>>>
  constexpr View(const C &from) noexcept : View(std::data(from), std::size(from)) {}
  constexpr View(std::initializer_list<T> list) noexcept : View(list.begin(), list.size()) {}

  constexpr const T *data() const noexcept { return data_; }
  constexpr std::size_t size() const noexcept { return size_; }
  constexpr bool empty() const noexcept { return size_ == 0; }
  constexpr const T *begin() const noexcept { return data_; }
  constexpr const T *end() const noexcept { return data_ + size_; }
  constexpr const T &operator[](std::size_t i) const noexcept { return data_[i]; }

 private:
  const T *data_ = nullptr;
  std::size_t size_ = 0;
};

/// Any callable that is called with the fraction done and returns false to cancel. It is referred
/// to, not copied: it must live as long as the call. It may throw: the call is then cancelled and
/// the exception goes on to the caller.
class Progress {
 public:
  Progress() noexcept = default;
  Progress(std::nullptr_t) noexcept {}
  Progress(bool (*function)(double)) noexcept : function_(function) {}
  template <class F, class G = std::remove_reference_t<F>,
            class = std::enable_if_t<!std::is_same_v<std::remove_cv_t<G>, Progress> &&
                                     std::is_class_v<G> && std::is_invocable_r_v<bool, G &, double>>>
  Progress(F &&callable) noexcept {
    // An empty std::function is none.
    if constexpr (std::is_constructible_v<bool, G &> &&
                  !std::is_convertible_v<G &, bool (*)(double)>) {
      if (!static_cast<bool>(callable)) return;
    }
    object_ = const_cast<void *>(static_cast<const void *>(std::addressof(callable)));
    call_ = [](void *object, double fraction) -> bool { return (*static_cast<G *>(object))(fraction); };
  }

  explicit operator bool() const noexcept { return call_ || function_; }
  bool operator()(double fraction) const {
    return call_ ? call_(object_, fraction) : function_(fraction);
  }

 private:
  void *object_ = nullptr;
  bool (*call_)(void *, double) = nullptr;
  bool (*function_)(double) = nullptr;
};

namespace detail {

struct Free {
  void operator()(morula_shape *p) const noexcept { morula_shape_free(p); }
  void operator()(morula_solid *p) const noexcept { morula_solid_free(p); }
  void operator()(morula_clump *p) const noexcept { morula_clump_free(p); }
  void operator()(morula_body *p) const noexcept { morula_body_free(p); }
  void operator()(morula_files *p) const noexcept { morula_files_free(p); }
  void operator()(morula_cost *p) const noexcept { morula_cost_free(p); }
  void operator()(morula_sweep *p) const noexcept { morula_sweep_free(p); }
  void operator()(morula_parent *p) const noexcept { morula_parent_free(p); }
  void operator()(morula_cache *p) const noexcept { morula_cache_free(p); }
  void operator()(morula_fragments *p) const noexcept { morula_fragments_free(p); }
};
template <class T>
using Handle = std::unique_ptr<T, Free>;

template <class Options>
Options defaults(std::int32_t (*init)(Options *, std::size_t)) {
  Options options;
  check(init(&options, sizeof options));
  return options;
}

/// A struct that the library fills.
template <class T, class Fill>
T filled(Fill fill) {
  T value{};
  value.struct_size = sizeof value;
  check(fill(&value));
  return value;
}

template <class Copy>
std::string text(Copy copy) {
  std::size_t length = 0;
  check(copy(0, nullptr, &length));
  std::string text(length, '\0');
  check(copy(length + 1, text.data(), nullptr));  // the last is the string's own NUL
  return text;
}

template <class Count, class Copy>
std::vector<std::string> texts(Count count, Copy copy) {
  std::size_t n = 0;
  check(count(&n));
  std::vector<std::string> all;
  all.reserve(n);
  for (std::size_t i = 0; i < n; ++i)
    all.push_back(text([&](std::size_t capacity, char *to, std::size_t *length) {
      return copy(i, capacity, to, length);
    }));
  return all;
}

/// Keeps a callable for the time of a call, and an exception that it threw.
struct Callback {
  Progress progress;
  std::exception_ptr thrown;
  static std::int32_t call(double fraction, void *user) noexcept {
    auto *self = static_cast<Callback *>(user);
    try {
      return self->progress(fraction) ? 0 : 1;
    } catch (...) {
      self->thrown = std::current_exception();
      return 1;
    }
  }
  template <class Options>
  void enter(Options &options) {
    if (!progress) return;
    options.progress = &Callback::call;
    options.user = this;
  }
};

/// Runs a call that makes a handle, with the progress function if there is one.
template <class T, class Options, class Make>
Handle<T> made(Options options, Progress progress, Make make) {
  Callback callback{progress, nullptr};
  callback.enter(options);
  T *raw = nullptr;
  const std::int32_t status = make(options, &raw);
  Handle<T> handle(raw);
  if (callback.thrown) std::rethrow_exception(callback.thrown);
  check(status);
  return handle;
}

/// The bytes that `write(capacity, bytes, size)` gives.
template <class Write>
std::vector<std::uint8_t> bytes(Write write) {
  std::size_t size = 0;
  check(write(std::size_t{0}, nullptr, &size));
  std::vector<std::uint8_t> all(size);
  check(write(size, all.data(), &size));
  return all;
}

/// x, y, z, r of each, in place.
inline const double *flat(View<Sphere> spheres) {
  return spheres.empty() ? nullptr : spheres[0].center.data();
}
/// As many spheres, filled by `copy(count, xyzr)`.
template <class Copy>
std::vector<Sphere> spheres(std::size_t count, Copy copy) {
  std::vector<Sphere> all(count);
  check(copy(count, all.empty() ? nullptr : all[0].center.data()));
  return all;
}
}  // namespace detail

/// Sets where the lines of the log go, for the whole program: sink(level, text), with one of
/// MORULA_LOG_*. It is kept, may be called from several threads, and what it throws is dropped.
/// Call this while no other call runs.
template <class Sink>
void set_log(Sink sink) {
  static std::optional<Sink> kept;
  kept.emplace(std::move(sink));
  check(morula_set_log(
      [](std::int32_t level, const char *text, void *user) {
        try {
          (*static_cast<Sink *>(user))(level, text);
        } catch (...) {
        }
      },
      &*kept));
}
/// No log any more.
inline void set_log(std::nullptr_t) { check(morula_set_log(nullptr, nullptr)); }

/// morula_import_options with the defaults.
struct ImportOptions : morula_import_options {
  ImportOptions() : morula_import_options(detail::defaults(morula_import_options_init)) {}
};
/// morula_file_options with the defaults.
struct FileOptions : morula_file_options {
  FileOptions() : morula_file_options(detail::defaults(morula_file_options_init)) {}
};
/// morula_solid_options with the defaults.
struct SolidOptions : morula_solid_options {
  SolidOptions() : morula_solid_options(detail::defaults(morula_solid_options_init)) {}
};
/// morula_clump_options with the defaults.
struct ClumpOptions : morula_clump_options {
  ClumpOptions() : morula_clump_options(detail::defaults(morula_clump_options_init)) {}
};

/// Voxels in space: cells along x, y, z (x fastest), edge lengths, lower corner.
struct Layout {
  std::array<std::size_t, 3> dims;
  std::array<double, 3> spacing{1.0, 1.0, 1.0};
  std::array<double, 3> origin{0.0, 0.0, 0.0};

  /// Throws unless `size` is the number of cells.
  void require(std::size_t size) const {
    if (dims[0] == 0 || dims[1] == 0 || size / dims[0] / dims[1] != dims[2] ||
        size != dims[0] * dims[1] * dims[2])
      throw Error(MORULA_STATUS_INVALID_ARGUMENT, "the array's size is not the product of dims");
  }
};

/// A parameter of a built-in particle: {"radius", 2.0}.
using Parameter = std::pair<std::string, double>;

/// What one camera sees of a particle: not 0 where a pixel shows it, row by row; the 3 x 4 camera
/// matrix by rows.
struct Silhouette {
  std::vector<std::uint8_t> mask;
  std::size_t width;
  std::size_t height;
  std::array<double, 12> camera;
};

/// A checked shape: something with an inside.
class Shape {
 public:
  /// From x, y, z of the vertices and three indices for each triangle.
  static Shape from_mesh(View<double> vertices,
                         View<std::uint32_t> triangles,
                         const ImportOptions &options = {}, Progress progress = {}) {
    if (vertices.size() % 3 != 0 || triangles.size() % 3 != 0)
      throw Error(MORULA_STATUS_INVALID_ARGUMENT, "vertices and triangles come in threes");
    return make(options, progress, [&](const auto &o, morula_shape **out) {
      return morula_shape_from_mesh(vertices.data(), vertices.size() / 3, triangles.data(),
                                    triangles.size() / 3, &o, out);
    });
  }
  /// From a file.
  static Shape from_file(const std::string &path, const ImportOptions &options = {},
                         const FileOptions &file = {}, Progress progress = {}) {
    return make(options, progress, [&](const auto &o, morula_shape **out) {
      return morula_shape_from_file(path.c_str(), &o, &file, out);
    });
  }
  /// From the bytes of a file; `name` helps where they do not tell the format.
  static Shape from_bytes(View<std::uint8_t> bytes, const std::string &name = {},
                          const ImportOptions &options = {}, const FileOptions &file = {},
                          Progress progress = {}) {
    return make(options, progress, [&](const auto &o, morula_shape **out) {
      return morula_shape_from_bytes(bytes.data(), bytes.size(), name.c_str(), &o, &file, out);
    });
  }
  /// What serialize() gave, to the last bit.
  static Shape deserialize(View<std::uint8_t> bytes) {
    morula_shape *raw = nullptr;
    check(morula_shape_deserialize(bytes.data(), bytes.size(), &raw));
    return Shape(detail::Handle<morula_shape>(raw));
  }
  /// As bytes, for another rank or a restart file.
  std::vector<std::uint8_t> serialize() const {
    return detail::bytes([&](std::size_t capacity, std::uint8_t *to, std::size_t *size) {
      return morula_shape_serialize(get(), capacity, to, size);
    });
  }
  /// From voxels: those that are not 0 are solid.
  static Shape from_mask(View<std::uint8_t> mask, const Layout &layout,
                         const ImportOptions &options = {}, Progress progress = {}) {
    layout.require(mask.size());
    return make(options, progress, [&](const auto &o, morula_shape **out) {
      return morula_shape_from_mask(mask.data(), layout.dims.data(), layout.spacing.data(),
                                    layout.origin.data(), &o, out);
    });
  }
  /// The visual hull of silhouettes, `cells` along its longest edge; carve is MORULA_CARVE_*.
  static Shape from_silhouettes(View<Silhouette> silhouettes, std::size_t cells = 64,
                                std::int32_t carve = MORULA_CARVE_TOUCHED,
                                const ImportOptions &options = {}, Progress progress = {}) {
    std::vector<std::uint8_t> masks;
    std::vector<std::size_t> widths, heights;
    std::vector<double> cameras;
    for (const auto &s : silhouettes) {
      if (s.mask.size() != s.width * s.height)
        throw Error(MORULA_STATUS_INVALID_ARGUMENT,
                    "a mask's size is not the product of width and height");
      masks.insert(masks.end(), s.mask.begin(), s.mask.end());
      widths.push_back(s.width);
      heights.push_back(s.height);
      cameras.insert(cameras.end(), s.camera.begin(), s.camera.end());
    }
    return make(options, progress, [&](const auto &o, morula_shape **out) {
      return morula_shape_from_silhouettes(widths.size(), masks.data(), widths.data(),
                                           heights.data(), cameras.data(), cells, carve, &o, out);
    });
  }
  /// From grey values; solid above *threshold, or above Otsu's threshold for a null pointer.
  static Shape from_grey(View<std::uint8_t> values, const Layout &layout,
                         const double *threshold = nullptr, const ImportOptions &options = {},
                         Progress progress = {}) {
    return grey(morula_shape_from_grey_u8, values, layout, threshold, options, progress);
  }
  static Shape from_grey(View<std::uint16_t> values, const Layout &layout,
                         const double *threshold = nullptr, const ImportOptions &options = {},
                         Progress progress = {}) {
    return grey(morula_shape_from_grey_u16, values, layout, threshold, options, progress);
  }
  static Shape from_grey(View<float> values, const Layout &layout,
                         const double *threshold = nullptr, const ImportOptions &options = {},
                         Progress progress = {}) {
    return grey(morula_shape_from_grey_f32, values, layout, threshold, options, progress);
  }
  /// From one label of a label volume.
  static Shape from_label(View<std::uint32_t> labels, const Layout &layout,
                          std::uint32_t label, const ImportOptions &options = {},
                          Progress progress = {}) {
    layout.require(labels.size());
    return make(options, progress, [&](const auto &o, morula_shape **out) {
      return morula_shape_from_label(labels.data(), layout.dims.data(), layout.spacing.data(),
                                     layout.origin.data(), label, &o, out);
    });
  }
  /// A built-in analytic particle; `parameters` as {"radius", 2.0}. The particles and what their
  /// parameters mean: the table at morula_shape_from_primitive() in morula.h.
  static Shape from_primitive(const std::string &name,
                              View<Parameter> parameters = {}, std::uint32_t segments = 0,
                              std::uint64_t seed = 0, const ImportOptions &options = {},
                              Progress progress = {}) {
    std::array<const char *, 16> keys{};
    std::array<double, 16> values{};
    if (parameters.size() > keys.size())
      throw Error(MORULA_STATUS_INVALID_ARGUMENT, "no particle has so many parameters");
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      keys[i] = parameters[i].first.c_str();
      values[i] = parameters[i].second;
    }
    return make(options, progress, [&](const auto &o, morula_shape **out) {
      return morula_shape_from_primitive(name.c_str(), keys.data(), values.data(),
                                         parameters.size(), segments, seed, &o, out);
    });
  }

  /// What was found in the input and what was done about it.
  morula_report report() const {
    return detail::filled<morula_report>(
        [&](morula_report *r) { return morula_shape_report(get(), r); });
  }
  /// What a user should know about the input.
  std::vector<std::string> notes() const {
    return detail::texts(
        [&](std::size_t *n) { return morula_shape_note_count(get(), n); },
        [&](std::size_t i, std::size_t capacity, char *to, std::size_t *length) {
          return morula_shape_copy_note(get(), i, capacity, to, length);
        });
  }
  /// Mass, centre and inertia.
  morula_moments moments(double density = 1.0) const {
    return detail::filled<morula_moments>(
        [&](morula_moments *m) { return morula_shape_moments(get(), density, m); });
  }
  /// Stage times and counters of the call that made it.
  morula_counters counters() const {
    return detail::filled<morula_counters>(
        [&](morula_counters *c) { return morula_shape_counters(get(), c); });
  }
  /// The C handle; it stays this object's.
  const morula_shape *get() const noexcept { return handle_.get(); }

 private:
  friend class Fragments;
  explicit Shape(detail::Handle<morula_shape> handle) : handle_(std::move(handle)) {}
  template <class Make>
  static Shape make(const ImportOptions &options, Progress progress, Make call) {
    return Shape(detail::made<morula_shape>(options, progress, call));
  }
  template <class T, class Make>
  static Shape grey(Make from_grey, View<T> values, const Layout &layout, const double *threshold,
                    const ImportOptions &options, Progress progress) {
    layout.require(values.size());
    return make(options, progress, [&](const auto &o, morula_shape **out) {
      return from_grey(values.data(), layout.dims.data(), layout.spacing.data(),
                       layout.origin.data(), threshold, &o, out);
    });
  }
  detail::Handle<morula_shape> handle_;
};

/// A built-in analytic particle with its parameters and their defaults.
struct Primitive {
  std::string name;
  std::vector<Parameter> parameters;
};

/// The built-in analytic particles.
inline std::vector<Primitive> primitives() {
  std::vector<Primitive> all;
  for (std::size_t k = 0; const char *name = morula_primitive_name(k); ++k) {
    std::size_t count = 0;
    check(morula_primitive_parameter_count(name, &count));
    Primitive primitive{name, {}};
    for (std::size_t i = 0; i < count; ++i) {
      double value = 0;
      std::string key = detail::text([&](std::size_t capacity, char *to, std::size_t *length) {
        return morula_primitive_copy_parameter(name, i, capacity, to, length, &value);
      });
      primitive.parameters.emplace_back(std::move(key), value);
    }
    all.push_back(std::move(primitive));
  }
  return all;
}

/// What a label volume holds of one label.
struct Label {
  std::uint32_t id;
  std::uint64_t cells;
  std::array<std::uint64_t, 3> first, last;
  bool touches_border;
};

namespace detail {
/// The labels that `list(capacity, ids, cells, boxes, touches_border, count)` gives; without
/// arrays it only counts.
template <class List>
std::vector<Label> labels(List list) {
  std::size_t n = 0;
  check(list(n, nullptr, nullptr, nullptr, nullptr, &n));
  std::vector<std::uint32_t> ids(n);
  std::vector<std::uint64_t> cells(n), boxes(6 * n);
  std::vector<std::int32_t> touches(n);
  check(list(n, ids.data(), cells.data(), boxes.data(), touches.data(), &n));
  std::vector<Label> all;
  for (std::size_t i = 0; i < ids.size() && i < n; ++i) {
    const std::uint64_t *b = &boxes[6 * i];
    all.push_back({ids[i], cells[i], {b[0], b[1], b[2]}, {b[3], b[4], b[5]}, touches[i] != 0});
  }
  return all;
}
}  // namespace detail

/// The labels of a volume, ascending, without 0.
inline std::vector<Label> labels(View<std::uint32_t> volume, const Layout &layout) {
  layout.require(volume.size());
  return detail::labels([&](std::size_t n, std::uint32_t *ids, std::uint64_t *cells,
                            std::uint64_t *boxes, std::int32_t *touches, std::size_t *count) {
    const auto *dims = layout.dims.data();
    return ids ? morula_labels_copy(volume.data(), dims, n, ids, cells, boxes, touches)
               : morula_labels_count(volume.data(), dims, count);
  });
}

/// The labels of a label volume in a file.
inline std::vector<Label> labels_from_file(const std::string &path,
                                           const ImportOptions &options = {},
                                           const FileOptions &file = {}) {
  return detail::labels([&](std::size_t n, auto... to) {
    return morula_labels_from_file(path.c_str(), &options, &file, n, to...);
  });
}

/// The same of the bytes of a file; `name` helps where they do not tell the format.
inline std::vector<Label> labels_from_bytes(View<std::uint8_t> bytes,
                                            const std::string &name = {},
                                            const ImportOptions &options = {},
                                            const FileOptions &file = {}) {
  return detail::labels([&](std::size_t n, auto... to) {
    return morula_labels_from_bytes(bytes.data(), bytes.size(), name.c_str(), &options, &file, n,
                                    to...);
  });
}

/// A shape with a grid.
class Solid {
 public:
  explicit Solid(const Shape &shape, const SolidOptions &options = {}, Progress progress = {})
      : handle_(detail::made<morula_solid>(
            options, progress, [&](const auto &o, morula_solid **out) {
              return morula_solid_from_shape(shape.get(), &o, out);
            })) {}

  /// The grid: cells, edge lengths, lower corner of the first cell.
  Layout grid() const {
    Layout layout{};
    check(morula_solid_grid(get(), layout.dims.data(), layout.spacing.data(),
                            layout.origin.data()));
    return layout;
  }
  /// Exact signed distances, negative inside; x, y, z of each point.
  std::vector<double> distance(View<double> points) const {
    if (points.size() % 3 != 0)
      throw Error(MORULA_STATUS_INVALID_ARGUMENT, "points come in threes");
    std::vector<double> distances(points.size() / 3);
    check(morula_solid_distance(get(), distances.size(), points.data(), distances.data()));
    return distances;
  }
  std::vector<std::string> notes() const {
    return detail::texts(
        [&](std::size_t *n) { return morula_solid_note_count(get(), n); },
        [&](std::size_t i, std::size_t capacity, char *to, std::size_t *length) {
          return morula_solid_copy_note(get(), i, capacity, to, length);
        });
  }
  morula_moments moments(double density = 1.0) const {
    return detail::filled<morula_moments>(
        [&](morula_moments *m) { return morula_solid_moments(get(), density, m); });
  }
  /// Stage times and counters of the calls that made its shape and itself.
  morula_counters counters() const {
    return detail::filled<morula_counters>(
        [&](morula_counters *c) { return morula_solid_counters(get(), c); });
  }
  const morula_solid *get() const noexcept { return handle_.get(); }

 private:
  detail::Handle<morula_solid> handle_;
};

/// A clump.
class Clump {
 public:
  explicit Clump(const Solid &solid, const ClumpOptions &options = {}, Progress progress = {})
      : handle_(detail::made<morula_clump>(
            options, progress, [&](const auto &o, morula_clump **out) {
              return morula_clump_from_solid(solid.get(), &o, out);
            })) {}
  /// Makes the solid inside.
  explicit Clump(const Shape &shape, const ClumpOptions &options = {},
                 const SolidOptions &solid = {}, Progress progress = {})
      : handle_(detail::made<morula_clump>(
            options, progress, [&](const auto &o, morula_clump **out) {
              return morula_clump_from_shape(shape.get(), &solid, &o, out);
            })) {}

  /// What serialize() gave, to the last bit; its counters are 0.
  static Clump deserialize(View<std::uint8_t> bytes) {
    morula_clump *raw = nullptr;
    check(morula_clump_deserialize(bytes.data(), bytes.size(), &raw));
    return Clump(detail::Handle<morula_clump>(raw));
  }
  /// As bytes, for another rank or a restart file.
  std::vector<std::uint8_t> serialize() const {
    return detail::bytes([&](std::size_t capacity, std::uint8_t *to, std::size_t *size) {
      return morula_clump_serialize(get(), capacity, to, size);
    });
  }

  std::size_t size() const {
    std::size_t n = 0;
    check(morula_clump_sphere_count(get(), &n));
    return n;
  }
  /// The spheres in the frame that the options asked for.
  std::vector<Sphere> spheres() const {
    return detail::spheres(size(), [&](std::size_t n, double *xyzr) {
      return morula_clump_copy_spheres(get(), n, xyzr);
    });
  }
  /// One of MORULA_STOPPED_*.
  std::int32_t stopped() const {
    std::int32_t stopped = 0;
    check(morula_clump_stopped(get(), &stopped));
    return stopped;
  }
  /// What is to be said of it: fewer spheres than were asked for, a deadline, a demand that could
  /// not be met; else empty.
  std::string note() const {
    return detail::text([&](std::size_t capacity, char *to, std::size_t *length) {
      return morula_clump_copy_note(get(), capacity, to, length);
    });
  }
  /// The limits of the method, of the numbers or of the measure that it meets; mostly none.
  std::vector<Warning> warnings() const {
    std::size_t n = 0;
    check(morula_clump_warning_count(get(), &n));
    std::vector<std::int32_t> codes(n);
    std::vector<double> figures(n), bounds(n);
    check(morula_clump_copy_warnings(get(), n, codes.data(), figures.data(), bounds.data()));
    std::vector<Warning> all;
    for (std::size_t i = 0; i < n; ++i)
      all.push_back({codes[i], figures[i], bounds[i],
                     detail::text([&](std::size_t capacity, char *to, std::size_t *length) {
                       return morula_clump_copy_warning(get(), i, capacity, to, length);
                     })});
    return all;
  }
  /// Mass, centre and inertia of the target, in the input frame.
  morula_moments moments(double density = 1.0) const {
    return detail::filled<morula_moments>(
        [&](morula_moments *m) { return morula_clump_moments(get(), density, m); });
  }
  morula_overlap overlap() const {
    return detail::filled<morula_overlap>(
        [&](morula_overlap *o) { return morula_clump_overlap(get(), o); });
  }
  morula_surface surface() const {
    return detail::filled<morula_surface>(
        [&](morula_surface *s) { return morula_clump_surface(get(), s); });
  }
  /// Exposed area of each sphere.
  std::vector<double> exposed_areas() const {
    std::vector<double> areas(size());
    check(morula_clump_copy_exposed_areas(get(), areas.size(), areas.data()));
    return areas;
  }
  /// Most spheres that one plane touches, for each of the `count` tolerances of the options.
  std::vector<std::uint32_t> plane_contacts(std::size_t count) const {
    std::vector<std::uint32_t> counts(count);
    check(morula_clump_copy_plane_contacts(get(), counts.size(), counts.data()));
    return counts;
  }
  /// Stage times and counters of the calls that made its shape, its solid and itself.
  morula_counters counters() const {
    return detail::filled<morula_counters>(
        [&](morula_counters *c) { return morula_clump_counters(get(), c); });
  }
  const morula_clump *get() const noexcept { return handle_.get(); }

  /// Levels of detail: a clump with each of these numbers of spheres, in this order.
  static std::vector<Clump> levels(const Solid &solid, View<std::uint64_t> spheres,
                                   const ClumpOptions &options = {}, Progress progress = {}) {
    return many(spheres.size(), options, progress,
                [&](const auto &o, morula_clump **out) {
                  return morula_clumps_from_solid(solid.get(), &o, spheres.data(),
                                                  spheres.size(), out);
                });
  }
  /// A clump of each shape, which threads share; throws for the first that fails.
  static std::vector<Clump> of_shapes(View<const Shape *> shapes,
                                      const ClumpOptions &options = {},
                                      const SolidOptions &solid = {}, Progress progress = {}) {
    std::vector<const morula_shape *> handles;
    for (const auto *shape : shapes) handles.push_back(shape ? shape->get() : nullptr);
    return many(shapes.size(), options, progress,
                [&](const auto &o, morula_clump **out) {
                  return morula_clumps_from_shapes(handles.data(), handles.size(), &solid, &o,
                                                   out, nullptr);
                });
  }
  /// A clump of each of these labels of a label volume, which threads share; throws for the
  /// first that fails.
  static std::vector<Clump> of_labels(View<std::uint32_t> labels,
                                      const Layout &layout,
                                      View<std::uint32_t> wanted,
                                      const ClumpOptions &options = {},
                                      const ImportOptions &import = {},
                                      const SolidOptions &solid = {}, Progress progress = {}) {
    layout.require(labels.size());
    return many(wanted.size(), options, progress,
                [&](const auto &o, morula_clump **out) {
                  return morula_clumps_from_labels(
                      labels.data(), layout.dims.data(), layout.spacing.data(),
                      layout.origin.data(), wanted.data(), wanted.size(), &import, &solid, &o,
                      out, nullptr);
                });
  }

 private:
  friend class Cost;
  explicit Clump(detail::Handle<morula_clump> handle) : handle_(std::move(handle)) {}
  template <class Make>
  static std::vector<Clump> many(std::size_t count, ClumpOptions options, Progress progress,
                                 Make make) {
    detail::Callback callback{progress, nullptr};
    callback.enter(options);
    std::vector<Clump> all;
    all.reserve(count);
    std::vector<morula_clump *> raw(count, nullptr);
    const std::int32_t status = make(options, raw.data());
    for (auto *clump : raw)
      if (clump) all.push_back(Clump(detail::Handle<morula_clump>(clump)));
    if (callback.thrown) std::rethrow_exception(callback.thrown);
    check(status);
    return all;
  }
  detail::Handle<morula_clump> handle_;
};

/// morula_mass_options with the defaults.
struct MassOptions : morula_mass_options {
  MassOptions() : morula_mass_options(detail::defaults(morula_mass_options_init)) {}
};
/// morula_contact_options with the defaults.
struct ContactOptions : morula_contact_options {
  ContactOptions() : morula_contact_options(detail::defaults(morula_contact_options_init)) {}
};
/// morula_export_options with the defaults.
struct ExportOptions : morula_export_options {
  ExportOptions() : morula_export_options(detail::defaults(morula_export_options_init)) {}
};

/// A file of a DEM code: what its name adds to the path, and its bytes.
struct File {
  std::string name;
  std::vector<std::uint8_t> bytes;
};

/// A weighed clump: spheres with masses, and what a solver takes of the whole.
class Body {
 public:
  explicit Body(const Clump &clump, const MassOptions &options = {}, Progress progress = {})
      : handle_(detail::made<morula_body>(
            options, progress, [&](const auto &o, morula_body **out) {
              return morula_body_from_clump(clump.get(), &o, out);
            })) {}
  /// Spheres that were made elsewhere, in the frame of `solid`, or with NULL their union.
  explicit Body(View<Sphere> spheres, const Solid *solid = nullptr,
                const MassOptions &options = {}, Progress progress = {}) {
    handle_ = detail::made<morula_body>(
        options, progress, [&](const auto &o, morula_body **out) {
          return morula_body_from_spheres(detail::flat(spheres), spheres.size(),
                                          solid ? solid->get() : nullptr, &o, out);
        });
  }

  std::size_t size() const {
    std::size_t n = 0;
    check(morula_body_sphere_count(get(), &n));
    return n;
  }
  /// The spheres in a frame, one of MORULA_FRAME_*.
  std::vector<Sphere> spheres(std::int32_t frame = MORULA_FRAME_INPUT) const {
    return detail::spheres(size(), [&](std::size_t n, double *xyzr) {
      return morula_body_copy_spheres(get(), frame, n, xyzr);
    });
  }
  /// x, y, z, r of each for codes of single precision, each within the sphere it stands for.
  std::vector<float> spheres_f32(std::int32_t frame = MORULA_FRAME_BODY) const {
    std::vector<float> xyzr(4 * size());
    check(morula_body_copy_spheres_f32(get(), frame, xyzr.size() / 4, xyzr.data()));
    return xyzr;
  }
  /// The mass of each sphere.
  std::vector<double> masses() const {
    std::vector<double> masses(size());
    check(morula_body_copy_masses(get(), masses.size(), masses.data()));
    return masses;
  }
  /// How far they add up to the body.
  morula_masses result() const {
    return detail::filled<morula_masses>(
        [&](morula_masses *m) { return morula_body_masses(get(), m); });
  }
  /// The spheres whose mass is m_min or m_max.
  std::vector<std::uint32_t> binding() const {
    std::vector<std::uint32_t> spheres(result().binding);
    check(morula_body_copy_binding(get(), spheres.size(), spheres.data()));
    return spheres;
  }
  /// Mass, centre, inertia and body frame of the whole.
  morula_moments moments() const {
    return detail::filled<morula_moments>(
        [&](morula_moments *m) { return morula_body_moments(get(), m); });
  }
  /// The same body in another size, place, orientation (w, x, y, z) and density (0: its own).
  Body transform(double scale, const std::array<double, 3> &position = {},
                 const std::array<double, 4> &quaternion = {1, 0, 0, 0},
                 double density = 0) const {
    morula_body *raw = nullptr;
    check(morula_body_transform(get(), scale, position.data(), quaternion.data(), density, &raw));
    return Body(detail::Handle<morula_body>(raw));
  }
  /// The time step that it allows.
  morula_timestep timestep(const ContactOptions &contact) const {
    return detail::filled<morula_timestep>(
        [&](morula_timestep *t) { return morula_body_timestep(get(), &contact, t); });
  }
  /// Writes the file or files of a format, one of MORULA_EXPORT_*.
  void write(std::int32_t format, const std::string &path,
             const ExportOptions &options = {}) const {
    check(morula_body_write(get(), format, &options, path.c_str()));
  }
  /// The same in memory.
  std::vector<File> files(std::int32_t format, const ExportOptions &options = {}) const {
    morula_files *raw = nullptr;
    check(morula_body_export(get(), format, &options, &raw));
    const detail::Handle<morula_files> handle(raw);
    const auto names = detail::texts(
        [&](std::size_t *n) { return morula_files_count(raw, n); },
        [&](std::size_t i, std::size_t capacity, char *to, std::size_t *length) {
          return morula_files_copy_name(raw, i, capacity, to, length);
        });
    std::vector<File> all;
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::size_t size = 0;
      check(morula_files_size(raw, i, &size));
      File file{names[i], std::vector<std::uint8_t>(size)};
      check(morula_files_copy_bytes(raw, i, size, file.bytes.data()));
      all.push_back(std::move(file));
    }
    return all;
  }
  const morula_body *get() const noexcept { return handle_.get(); }

 private:
  friend Body transform(const Clump &, double, const std::array<double, 3> &,
                        const std::array<double, 4> &, const MassOptions &);
  explicit Body(detail::Handle<morula_body> handle) : handle_(std::move(handle)) {}
  detail::Handle<morula_body> handle_;
};

/// A clump weighed and placed in one call, as Body(clump, masses).transform().
inline Body transform(const Clump &clump, double scale, const std::array<double, 3> &position = {},
                      const std::array<double, 4> &quaternion = {1, 0, 0, 0},
                      const MassOptions &masses = {}) {
  morula_body *raw = nullptr;
  check(morula_clump_transform(clump.get(), &masses, scale, position.data(), quaternion.data(),
                               &raw));
  return Body(detail::Handle<morula_body>(raw));
}
/// The time step that a clump allows, weighed in the same call.
inline morula_timestep timestep(const Clump &clump, const ContactOptions &contact,
                                const MassOptions &masses = {}) {
  return detail::filled<morula_timestep>([&](morula_timestep *t) {
    return morula_clump_timestep(clump.get(), &masses, &contact, t);
  });
}
/// Weighs a clump and writes it in a format, one of MORULA_EXPORT_*.
inline void write(const Clump &clump, std::int32_t format, const std::string &path,
                  const MassOptions &masses = {}, const ExportOptions &options = {}) {
  check(morula_clump_write(clump.get(), &masses, format, &options, path.c_str()));
}

/// morula_break_options with the defaults.
struct BreakOptions : morula_break_options {
  BreakOptions() : morula_break_options(detail::defaults(morula_break_options_init)) {}
};
/// A body as a solver holds it; at first at rest at the origin, without mass.
struct Held : morula_held {
  Held() : morula_held(detail::defaults(morula_held_init)) {}
  Held(const morula_held &held) : morula_held(held) {}
};

/// How a rigid body stands and moves in the world: the quaternion (w, x, y, z) is that of its body
/// axes.
struct Motion {
  std::array<double, 3> position{};
  std::array<double, 4> quaternion{1, 0, 0, 0};
  std::array<double, 3> velocity{};
  std::array<double, 3> angular_velocity{};
};

/// A particle that may break: its solid and the spheres of its clump.
class Parent {
 public:
  Parent(const Solid &solid, const Clump &clump, std::int32_t threads = 1) {
    morula_parent *raw = nullptr;
    check(morula_parent_from_clump(solid.get(), clump.get(), threads, &raw));
    handle_.reset(raw);
  }
  /// Spheres that were made elsewhere, in the frame of the solid; there may be none.
  explicit Parent(const Solid &solid, View<Sphere> spheres = {},
                  std::int32_t threads = 1) {
    morula_parent *raw = nullptr;
    check(morula_parent_from_solid(solid.get(), detail::flat(spheres), spheres.size(), threads, &raw));
    handle_.reset(raw);
  }

  /// The whole body in its place in the world.
  Held held(double density, const Motion &m, double scale = 1) const {
    return detail::filled<morula_held>([&](morula_held *h) {
      return morula_parent_held(get(), density, scale, m.position.data(), m.quaternion.data(),
                                m.velocity.data(), m.angular_velocity.data(), h);
    });
  }
  /// The whole body at rest where the shape has it.
  Held held(double density, double scale = 1) const {
    return detail::filled<morula_held>([&](morula_held *h) {
      return morula_parent_held(get(), density, scale, nullptr, nullptr, nullptr, nullptr, h);
    });
  }
  /// Bytes beside the solid.
  std::uint64_t bytes() const {
    std::uint64_t bytes = 0;
    check(morula_parent_bytes(get(), &bytes));
    return bytes;
  }
  const morula_parent *get() const noexcept { return handle_.get(); }

 private:
  friend class Cache;
  explicit Parent(detail::Handle<morula_parent> handle) : handle_(std::move(handle)) {}
  detail::Handle<morula_parent> handle_;
};

/// Prepared parents that are used again, within a bound of bytes; the caller's own.
class Cache {
 public:
  explicit Cache(std::uint64_t limit) {
    morula_cache *raw = nullptr;
    check(morula_cache_new(limit, &raw));
    handle_.reset(raw);
  }
  /// The parent that was made before of the same shape, grid and spheres, else a new one.
  Parent parent(const Shape &shape, View<Sphere> spheres = {},
                const SolidOptions &options = {}, Progress progress = {}) const {
    return Parent(detail::made<morula_parent>(
        options, progress, [&](const auto &o, morula_parent **out) {
          return morula_cache_parent(get(), shape.get(), &o, detail::flat(spheres), spheres.size(),
                                     out);
        }));
  }
  /// What it has done, and what it holds.
  morula_cache_counts counters() const {
    return detail::filled<morula_cache_counts>(
        [&](morula_cache_counts *c) { return morula_cache_counters(get(), c); });
  }
  /// Lets all parents go.
  void clear() { check(morula_cache_clear(get())); }
  const morula_cache *get() const noexcept { return handle_.get(); }

 private:
  detail::Handle<morula_cache> handle_;
};

/// Which spheres of what broke those of a fragment come from: those of sphere i are the pairs
/// starts[i] up to starts[i + 1], the last excluded.
struct ParentMap {
  std::vector<std::uint32_t> starts, parents;
  std::vector<double> shares;
};

/// The fragments of one break, and its dust.
class Fragments {
 public:
  Fragments(const Parent &parent, const Held &held, const BreakOptions &options = {},
            Progress progress = {})
      : handle_(detail::made<morula_fragments>(
            options, progress, [&](const auto &o, morula_fragments **out) {
              return morula_parent_break(parent.get(), nullptr, 0, &held, &o, out);
            })) {}
  /// Fragment `index` of an earlier break breaks again.
  Fragments(const Fragments &from, std::size_t index, const Held &held,
            const BreakOptions &options = {}, Progress progress = {})
      : handle_(detail::made<morula_fragments>(
            options, progress, [&](const auto &o, morula_fragments **out) {
              return morula_parent_break(nullptr, from.get(), index, &held, &o, out);
            })) {}
  /// The pieces of a label volume, as a fracture model gives them; `spheres` are those of the body.
  static Fragments from_labels(View<std::uint32_t> labels, const Layout &layout,
                               View<Sphere> spheres, const Held &held,
                               const BreakOptions &options = {}, const SolidOptions &grid = {},
                               Progress progress = {}) {
    layout.require(labels.size());
    return Fragments(detail::made<morula_fragments>(
        options, progress, [&](const auto &o, morula_fragments **out) {
          return morula_fragments_from_labels(labels.data(), layout.dims.data(),
                                              layout.spacing.data(), layout.origin.data(), &grid,
                                              detail::flat(spheres), spheres.size(), &held, &o,
                                              out);
        }));
  }
  /// New spheres for a shape that has changed, from the old ones.
  static Fragments reclump_shape(const Solid &solid, View<Sphere> old,
                                 const Held &held, const BreakOptions &options = {},
                                 Progress progress = {}) {
    return Fragments(detail::made<morula_fragments>(
        options, progress, [&](const auto &o, morula_fragments **out) {
          return morula_reclump_shape(solid.get(), detail::flat(old), old.size(), &held, &o, out);
        }));
  }
  /// What serialize() gave, as fragment 0, beside a parent of the same shape and grid.
  static Fragments deserialize(const Parent &parent, View<std::uint8_t> bytes,
                               const Held &held) {
    morula_fragments *raw = nullptr;
    check(morula_fragments_deserialize(parent.get(), bytes.data(), bytes.size(), &held, &raw));
    return Fragments(detail::Handle<morula_fragments>(raw));
  }
  /// A fragment as bytes, for another rank or a restart file.
  std::vector<std::uint8_t> serialize(std::size_t index) const {
    return detail::bytes([&](std::size_t capacity, std::uint8_t *to, std::size_t *size) {
      return morula_fragments_serialize(get(), index, capacity, to, size);
    });
  }
  /// All breaks of one time step, which threads (those of the first options) share; throws for the
  /// first that fails.
  static std::vector<Fragments> of_parents(View<const Parent *> parents,
                                           View<Held> held,
                                           View<BreakOptions> options) {
    if (held.size() != parents.size() || options.size() != parents.size())
      throw Error(MORULA_STATUS_INVALID_ARGUMENT, "a held body and options for each parent");
    std::vector<const morula_parent *> handles;
    for (const auto *parent : parents) handles.push_back(parent ? parent->get() : nullptr);
    std::vector<morula_fragments *> raw(parents.size(), nullptr);
    check(morula_parents_break(handles.data(), nullptr, nullptr, held.data(), options.data(),
                               handles.size(), raw.data(), nullptr));
    std::vector<detail::Handle<morula_fragments>> owned;
    for (auto *fragments : raw) owned.emplace_back(fragments);
    std::vector<Fragments> all;
    for (auto &handle : owned) all.push_back(Fragments(std::move(handle)));
    return all;
  }

  std::size_t size() const {
    std::size_t n = 0;
    check(morula_fragments_count(get(), &n));
    return n;
  }
  /// What a solver takes of a fragment, and its quality.
  morula_fragment operator[](std::size_t index) const {
    return detail::filled<morula_fragment>(
        [&](morula_fragment *f) { return morula_fragments_get(get(), index, f); });
  }
  /// What the pieces of the dust take over.
  std::vector<morula_fragment> dust() const {
    std::size_t n = 0;
    check(morula_fragments_dust_count(get(), &n));
    std::vector<morula_fragment> all;
    for (std::size_t i = 0; i < n; ++i)
      all.push_back(detail::filled<morula_fragment>(
          [&](morula_fragment *f) { return morula_fragments_dust(get(), i, f); }));
    return all;
  }
  morula_break_totals totals() const {
    return detail::filled<morula_break_totals>(
        [&](morula_break_totals *t) { return morula_fragments_totals(get(), t); });
  }
  /// A fragment as it was handed over, for it to break again.
  Held held(std::size_t index) const {
    return detail::filled<morula_held>([&](morula_held *h) {
      return morula_fragments_held(get(), index, nullptr, nullptr, nullptr, nullptr, h);
    });
  }
  /// A fragment as the solver holds it now, for it to break again.
  Held held(std::size_t index, const Motion &m) const {
    return detail::filled<morula_held>([&](morula_held *h) {
      return morula_fragments_held(get(), index, m.position.data(), m.quaternion.data(),
                                   m.velocity.data(), m.angular_velocity.data(), h);
    });
  }
  /// The spheres in a frame, one of MORULA_FRAME_*.
  std::vector<Sphere> spheres(std::size_t index, std::int32_t frame = MORULA_FRAME_INPUT) const {
    return detail::spheres((*this)[index].sphere_count, [&](std::size_t n, double *xyzr) {
      return morula_fragments_copy_spheres(get(), index, frame, n, xyzr);
    });
  }
  /// The same, grown by a part from 0 to 1 as far as the others, in that frame, leave room.
  std::vector<Sphere> grown(std::size_t index, double part, View<Sphere> others,
                            double gap = 0, std::int32_t frame = MORULA_FRAME_INPUT) const {
    return detail::spheres((*this)[index].sphere_count, [&](std::size_t n, double *xyzr) {
      return morula_fragments_grow(get(), index, part, detail::flat(others), others.size(), gap,
                                   frame, n, xyzr);
    });
  }
  /// The mass of each sphere.
  std::vector<double> masses(std::size_t index) const {
    std::vector<double> masses((*this)[index].sphere_count);
    check(morula_fragments_copy_masses(get(), index, masses.size(), masses.data()));
    return masses;
  }
  ParentMap map(std::size_t index) const {
    const auto f = (*this)[index];
    ParentMap map;
    map.starts.resize(f.sphere_count + 1);
    map.parents.resize(f.map_count);
    map.shares.resize(f.map_count);
    check(morula_fragments_copy_map(get(), index, map.starts.data(), map.parents.size(),
                                    map.parents.data(), map.shares.data()));
    return map;
  }
  /// The half-spaces that bound it: normal and offset each.
  std::vector<std::array<double, 4>> half_spaces(std::size_t index) const {
    std::vector<std::array<double, 4>> all((*this)[index].half_space_count);
    check(morula_fragments_copy_half_spaces(get(), index, all.size(),
                                            all.empty() ? nullptr : all[0].data()));
    return all;
  }
  /// The surface of a fragment.
  Shape shape(std::size_t index) const {
    morula_shape *raw = nullptr;
    check(morula_fragments_shape(get(), index, &raw));
    return Shape(detail::Handle<morula_shape>(raw));
  }
  std::vector<std::string> notes() const {
    return detail::texts(
        [&](std::size_t *n) { return morula_fragments_note_count(get(), n); },
        [&](std::size_t i, std::size_t capacity, char *to, std::size_t *length) {
          return morula_fragments_copy_note(get(), i, capacity, to, length);
        });
  }
  const morula_fragments *get() const noexcept { return handle_.get(); }

 private:
  explicit Fragments(detail::Handle<morula_fragments> handle) : handle_(std::move(handle)) {}
  detail::Handle<morula_fragments> handle_;
};

/// morula_cost_options with the defaults.
struct CostOptions : morula_cost_options {
  CostOptions() : morula_cost_options(detail::defaults(morula_cost_options_init)) {}
};
/// morula_cost_bounds with the defaults.
struct CostBounds : morula_cost_bounds {
  CostBounds() : morula_cost_bounds(detail::defaults(morula_cost_bounds_init)) {}
};

/// A line that was chosen from a price list, and why.
struct CostChoice {
  std::size_t index;
  std::string why;
};

/// A price list: for each number of spheres how good the clump is, how long it took and what a
/// solver pays for it.
class Cost {
 public:
  explicit Cost(const Solid &solid, const ClumpOptions &options = {}, const CostOptions &cost = {},
                Progress progress = {})
      : handle_(detail::made<morula_cost>(
            options, progress, [&](const auto &o, morula_cost **out) {
              return morula_cost_curve(solid.get(), &o, &cost, out);
            })) {}

  std::size_t size() const {
    std::size_t n = 0;
    check(morula_cost_count(get(), &n));
    return n;
  }
  /// Whether cancel or the deadline ended it early.
  bool cut() const {
    std::int32_t cut = 0;
    check(morula_cost_cut(get(), &cut));
    return cut != 0;
  }
  /// All lines, by the number of spheres.
  std::vector<morula_cost_point> points() const {
    std::vector<morula_cost_point> all(size());
    all[0].struct_size = sizeof all[0];
    check(morula_cost_copy(get(), all.size(), all.data()));
    return all;
  }
  /// The clump of a line, which lives on without the list.
  Clump clump(std::size_t index) const {
    morula_clump *raw = nullptr;
    check(morula_cost_clump(get(), index, &raw));
    return Clump(detail::Handle<morula_clump>(raw));
  }
  /// The best line within bounds; by default the knee, where more spheres stop paying.
  CostChoice choose(const CostBounds &bounds = {}) const {
    CostChoice choice{0, {}};
    choice.why = detail::text([&](std::size_t capacity, char *to, std::size_t *length) {
      return morula_cost_choose(get(), &bounds, &choice.index, capacity, to, length);
    });
    return choice;
  }
  const morula_cost *get() const noexcept { return handle_.get(); }

 private:
  friend class Sweep;
  explicit Cost(detail::Handle<morula_cost> handle) : handle_(std::move(handle)) {}
  detail::Handle<morula_cost> handle_;
};

/// What is swept over: every resolution with every method and every deadline.
struct SweepOver {
  /// Numbers of cells along what SolidOptions::resolution says, or edges of a cell.
  std::vector<double> resolutions;
  /// MORULA_METHOD_*.
  std::vector<std::int32_t> methods;
  /// MORULA_EFFORT_*, as many as methods; none: that of the clump options for all.
  std::vector<std::int32_t> efforts;
  /// Seconds that each clump may take; 0: as long as it takes.
  std::vector<double> deadlines{0.0};
};

/// Price lists of one shape over resolutions, methods and deadlines.
class Sweep {
 public:
  explicit Sweep(const Shape &shape, const SweepOver &over, const SolidOptions &solid = {},
                 const ClumpOptions &options = {}, const CostOptions &cost = {},
                 Progress progress = {})
      : handle_(detail::made<morula_sweep>(
            options, progress, [&](const auto &o, morula_sweep **out) {
              if (!over.efforts.empty() && over.efforts.size() != over.methods.size())
                throw Error(MORULA_STATUS_INVALID_ARGUMENT,
                            "a sweep needs as many efforts as methods, or none");
              auto what = detail::defaults(morula_sweep_options_init);
              what.resolutions = over.resolutions.data();
              what.resolution_count = over.resolutions.size();
              what.methods = over.methods.data();
              what.efforts = over.efforts.empty() ? nullptr : over.efforts.data();
              what.method_count = over.methods.size();
              what.deadlines = over.deadlines.data();
              what.deadline_count = over.deadlines.size();
              return morula_sweep_from_shape(shape.get(), &solid, &o, &cost, &what, out);
            })) {}

  std::size_t size() const {
    std::size_t n = 0;
    check(morula_sweep_count(get(), &n));
    return n;
  }
  /// What each list is of: the resolutions one after the other, in each the methods, of each the
  /// deadlines.
  std::vector<morula_swept> lists() const {
    std::vector<morula_swept> all(size());
    all[0].struct_size = sizeof all[0];
    check(morula_sweep_copy(get(), all.size(), all.data()));
    return all;
  }
  /// A list, which lives on without the sweep. Throws why it could not be made.
  Cost curve(std::size_t index) const {
    morula_cost *raw = nullptr;
    check(morula_sweep_curve(get(), index, &raw));
    return Cost(detail::Handle<morula_cost>(raw));
  }
  const morula_sweep *get() const noexcept { return handle_.get(); }

 private:
  detail::Handle<morula_sweep> handle_;
};

/// Rotations (w, x, y, z) drawn evenly from all: the same for the same seed.
inline std::vector<std::array<double, 4>> random_orientations(std::uint64_t seed,
                                                              std::size_t count) {
  std::vector<std::array<double, 4>> all(count);
  check(morula_random_orientations(seed, count, all.empty() ? nullptr : all[0].data()));
  return all;
}

}  // namespace morula

#endif
