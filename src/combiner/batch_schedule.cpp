#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "src/combiner/batch_compiler.h"
#include "src/combiner/batch_plan.h"

namespace ninebit::detail {
namespace {

class Scheduler {
 public:
  explicit Scheduler(const ValueGraph& graph) : graph_(graph), home_(graph.nodes().size()), last_use_(home_.size()) {}

  VectorCode run(const std::vector<WantedValue>& wanted) {
    std::vector<Value> values;
    for (const WantedValue& w : wanted) values.push_back(w.value);
    const std::vector<PlannedOperation> operations = plan(graph_, values);
    for (std::size_t i = 0; i < operations.size(); ++i) {
      for (std::size_t k = 0; k < sources_of(operations[i]); ++k) last_use_[operations[i].of[k]] = i;
    }
    for (const WantedValue& w : wanted) {
      last_use_[w.value] = operations.size();
      // No operation reads a colour's plane, so the wanted value is computed there directly.
      const bool is_operation = graph_.nodes()[w.value].source == Source::operation;
      if (w.plane.space == Space::colors && is_operation && !home_[w.value]) home_[w.value] = w.plane;
    }
    for (std::size_t i = 0; i < operations.size(); ++i) emit(operations[i], i);
    deliver(wanted);
    return std::move(code_);
  }

 private:
  static std::size_t sources_of(const PlannedOperation& operation) {
    return static_cast<std::size_t>(operation.formula.sources());
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

  // `place` is the operation's place in the order of all.
  void emit(const PlannedOperation& planned, std::size_t place) {
    VectorOperation operation;
    operation.formula = planned.formula;
    operation.lines = planned.lines;
    operation.line = planned.line;
    const std::size_t sources = sources_of(planned);
    for (std::size_t k = 0; k < sources; ++k) operation.source[k] = plane_of(planned.of[k]);
    // Kernels read a lane of all sources before they write that lane, so a source's plane may become the target.
    for (std::size_t k = 0; k < sources; ++k) {
      const PlanePlace plane = operation.source[k];
      const auto here = operation.source.begin() + static_cast<std::ptrdiff_t>(k);
      const bool seen = std::find(operation.source.begin(), here, plane) != here;
      if (last_use_[planned.of[k]] == place && plane.space == Space::temporaries && !seen) free_.push_back(plane);
    }
    std::optional<PlanePlace>& home = home_[planned.value];
    if (!home) home = new_temporary();
    operation.target = *home;
    if (last_ != nullptr && planned.is_like(*last_)) {
      ++code_.operations[first_alike_].alike;
    } else {
      first_alike_ = code_.operations.size();
    }
    last_ = &planned;
    code_.operations.push_back(operation);
  }

  void copy(const PlanePlace& from, const PlanePlace& to) {
    VectorOperation operation;
    operation.source[0] = from;
    operation.target = to;
    code_.operations.push_back(operation);
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
  const PlannedOperation* last_ = nullptr;  // the last one emitted
  std::size_t first_alike_ = 0;             // the first of the operations that are like it
};

}  // namespace

VectorCode schedule(const ValueGraph& graph, const std::vector<WantedValue>& wanted) {
  return Scheduler(graph).run(wanted);
}

}  // namespace ninebit::detail
