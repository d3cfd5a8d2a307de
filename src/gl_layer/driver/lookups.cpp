#include "src/gl_layer/driver/lookups.h"

#include <array>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "src/gl_layer/driver/log.h"

namespace ninebit::gl_layer {
namespace {

struct AskedExtension {
  Asked extension;
  std::string_view name;
  std::optional<Extra> extra;  // empty: it is always added
};
constexpr std::array kAsked{
    AskedExtension{Asked::combiners, "GL_NV_register_combiners", std::nullopt},
    AskedExtension{Asked::fence, "GL_NV_fence", Extra::fence},
    AskedExtension{Asked::vertex_array_range, "GL_NV_vertex_array_range", Extra::vertex_array_range},
    AskedExtension{Asked::vertex_program, "GL_NV_vertex_program", Extra::vertex_program},
    AskedExtension{Asked::paletted_texture, "GL_EXT_paletted_texture", Extra::paletted_texture}};

constinit std::atomic<unsigned> looked_up_bits{0}, used_bits{0}, drivers_bits{0};

void add(std::atomic<unsigned>& bits, Asked extension) {
  const auto bit = static_cast<unsigned>(extension);
  if ((bits.load(std::memory_order_relaxed) & bit) == 0) bits.fetch_or(bit, std::memory_order_relaxed);
}

bool has(const std::atomic<unsigned>& bits, Asked extension) {
  return (bits.load(std::memory_order_relaxed) & static_cast<unsigned>(extension)) != 0;
}

// The functions that a program did not get. Never destroyed: programs look up functions in their own destructors.
struct Missing {
  std::mutex mutex{};
  std::set<std::string, std::less<>> functions{};
};
Missing& missing() {
  static auto& all = *new Missing;
  return all;
}
constexpr std::size_t kMostMissing = 1000, kMostNamed = 20;

std::string join(const std::string& list, std::string_view word) {
  return list.empty() ? std::string(word) : list + ", " + std::string(word);
}

void write_missing() {
  const std::lock_guard lock(missing().mutex);
  std::string names;
  std::size_t named = 0;
  for (const std::string& function : missing().functions) {
    if (named++ < kMostNamed) names = join(names, function);
  }
  if (named > kMostNamed) names += " and " + std::to_string(named - kMostNamed) + " more";
  if (named != 0) log_line("looked up and not there: " + names);
}

// At the end of a process. Standard error is the program's: without a file nobody asked for these lines.
[[gnu::destructor]] void write_lookups() {
  const char* const file = std::getenv("NINEBIT_GL_LOG");
  if (file == nullptr || *file == '\0') return;
  std::string not_added, not_used;
  for (const AskedExtension& one : kAsked) {
    if (!has(looked_up_bits, one.extension) || has(drivers_bits, one.extension)) continue;
    if (one.extra && !wanted_extras().have(*one.extra)) {
      not_added = join(not_added, one.name.substr(3));
    } else if (!has(used_bits, one.extension)) {
      not_used = join(not_used, one.name);
    }
  }
  if (!not_added.empty()) log_line("functions looked up of extensions that --extensions can add: " + not_added);
  if (!not_used.empty()) log_line("functions looked up and never used: those of " + not_used);
  write_missing();
}

}  // namespace

void note_lookup(std::string_view function) {
  if (const auto extra = extra_of(function)) {
    for (const AskedExtension& one : kAsked) {
      if (one.extra == extra) add(looked_up_bits, one.extension);
    }
  } else if (function.starts_with("glCombiner") || function.starts_with("glFinalCombiner")) {
    add(looked_up_bits, Asked::combiners);
  }
}

void note_missing(std::string_view function) {
  const std::lock_guard lock(missing().mutex);
  if (missing().functions.size() < kMostMissing) missing().functions.emplace(function);
}

void note_use(Asked extension) {
  add(used_bits, extension);
}

void note_drivers_own(Extra extra) {
  for (const AskedExtension& one : kAsked) {
    if (one.extra == extra) add(drivers_bits, one.extension);
  }
}

}  // namespace ninebit::gl_layer
