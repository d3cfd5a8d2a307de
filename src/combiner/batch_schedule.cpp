#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "src/combiner/batch_compiler.h"

namespace ninebit::detail {
namespace {

class Scheduler {
 public:
  explicit Scheduler(const ValueGraph& graph) : graph_(graph), home_(graph.nodes().size()), last_use_(home_.size()) {}

  VectorCode run(const std::vector<WantedValue>& wanted) {
    mark_uses(wanted);
    for (const WantedValue& w : wanted) {
      // No operation reads a colour's plane, so the wanted value is computed there directly.
      const bool is_operation = graph_.nodes()[w.value].source == Source::operation;
      if (w.plane.space == Space::colors && is_operation && !home_[w.value]) home_[w.value] = w.plane;
    }
    for (std::size_t v = 0; v < home_.size(); ++v) {
      if (last_use_[v] != 0 && graph_.nodes()[v].source == Source::operation) emit(v);
    }
    deliver(wanted);
    return std::move(code_);
  }

 private:
  // Finds each value's last reader. A wanted value is read past all operations; 0 means that nothing reads it.
  void mark_uses(const std::vector<WantedValue>& wanted) {
    for (const WantedValue& w : wanted) last_use_[w.value] = home_.size();
    for (std::size_t v = home_.size(); v-- > 0;) {
      const ValueGraph::Node& node = graph_.nodes()[v];
      if (last_use_[v] == 0 || node.source != Source::operation) continue;
      for (int k = 0; k < node.formula.sources(); ++k) {
        std::size_t& last = last_use_[node.of[static_cast<std::size_t>(k)]];
        last = std::max(last, v);
      }
    }
  }

  PlanePlace new_temporary() {
    if (free_.empty()) return {Space::temporaries, static_cast<std::uint16_t>(code_.temporaries++)};
    const PlanePlace plane = free_.back();
    free_.pop_back();
    return plane;
  }

  PlanePlace constant_plane(int code) {
    const auto [at, is_new] = constants_.try_emplace(code, static_cast<std::uint16_t>(code_.constants.size()));
    if (is_new) code_.constants.emplace_back().lane.fill(static_cast<s9>(code));
    return {Space::constants, at->second};
  }

  PlanePlace plane_of(Value v) {
    const ValueGraph::Node& node = graph_.nodes()[v];
    switch (node.source) {
      case Source::constant:
        return constant_plane(node.number);
      case Source::input:
        code_.reads.add(static_cast<Register>(node.number / 4), node.number % 4);
        return {Space::registers, static_cast<std::uint16_t>(node.number)};
      case Source::operation:
        break;
    }
    return *home_[v];
  }

  void emit(std::size_t v) {
    const ValueGraph::Node& node = graph_.nodes()[v];
    VectorOperation operation{.formula = node.formula, .source = {}, .target = {}};
    const auto sources = static_cast<std::size_t>(node.formula.sources());
    for (std::size_t k = 0; k < sources; ++k) operation.source[k] = plane_of(node.of[k]);
    // Kernels read a lane of all sources before they write that lane, so a source's plane may become the target.
    for (std::size_t k = 0; k < sources; ++k) {
      const PlanePlace plane = operation.source[k];
      const bool seen = std::find(operation.source.begin(), operation.source.begin() + static_cast<std::ptrdiff_t>(k),
                                  plane) != operation.source.begin() + static_cast<std::ptrdiff_t>(k);
      if (last_use_[node.of[k]] == v && plane.space == Space::temporaries && !seen) free_.push_back(plane);
    }
    if (!home_[v]) home_[v] = new_temporary();
    operation.target = *home_[v];
    code_.operations.push_back(operation);
  }

  void copy(const PlanePlace& from, const PlanePlace& to) {
    code_.operations.push_back({.formula = {}, .source = {from}, .target = to});
  }

  // Copies the wanted values that were not computed in place. Registers come last: none is overwritten before all have
  // been read.
  void deliver(const std::vector<WantedValue>& wanted) {
    std::vector<std::pair<PlanePlace, PlanePlace>> late;
    for (const WantedValue& w : wanted) {
      PlanePlace from = plane_of(w.value);
      if (from == w.plane) continue;
      if (w.plane.space == Space::colors) {
        copy(from, w.plane);
        continue;
      }
      if (from.space == Space::registers) {
        const PlanePlace kept = new_temporary();
        copy(from, kept);
        from = kept;
      }
      late.emplace_back(from, w.plane);
    }
    for (const auto& [from, to] : late) copy(from, to);
  }

  const ValueGraph& graph_;
  VectorCode code_;
  std::vector<std::optional<PlanePlace>> home_;
  std::vector<std::size_t> last_use_;
  std::vector<PlanePlace> free_;
  std::map<int, std::uint16_t> constants_;
};

}  // namespace

VectorCode schedule(const ValueGraph& graph, const std::vector<WantedValue>& wanted) {
  return Scheduler(graph).run(wanted);
}

}  // namespace ninebit::detail
