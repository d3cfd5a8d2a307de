#include "src/language/emit/emit_printer.h"

#include <algorithm>
#include <limits>

namespace ninebit::emit {
namespace {

constexpr std::size_t kWidth = 116;

// Breaks a statement at spaces, which never occur inside a token or a comment here.
std::string wrapped(std::string line) {
  std::string out;
  while (line.size() > kWidth) {
    const std::size_t at = line.rfind(' ', kWidth);
    if (at == std::string::npos || at < 8) break;
    out += line.substr(0, at) + '\n';
    line = "      " + line.substr(at + 1);
  }
  return out + line + '\n';
}

}  // namespace

Printer::Printer(const Graph& graph, const std::vector<V>& results, const Dialect& dialect)
    : graph_(graph), dialect_(dialect), uses_(graph.size()), names_(graph.size()) {
  for (const V& v : results) count(v);
}

void Printer::statement(const std::string& text) {
  out_ += wrapped("  " + text + ';');
}

void Printer::count(const V& v) {
  const Interval r = v.range();
  range_ = {std::min(range_.low, r.low), std::max(range_.high, r.high)};
  if (v.is_constant()) return;
  const auto i = static_cast<std::size_t>(v.node);
  if (++uses_[i] > 1) return;
  const Node& node = graph_[v.node];
  if (node.opcode == Opcode::input) return;
  for (const V& arg : node.args) count(arg);
}

bool Printer::wants_name(int node) const {
  const Node& n = graph_[node];
  return n.opcode != Opcode::input && (n.named || uses_[static_cast<std::size_t>(node)] > 1);
}

void Printer::prepare(const V& v, const std::string& name_of_parts) {
  if (v.is_constant()) return;
  if (!names_[static_cast<std::size_t>(v.node)].empty()) return;
  const Node& node = graph_[v.node];
  if (node.opcode == Opcode::input) return;
  if (wants_name(v.node)) return declare(v.node, name_of_parts);
  for (const V& arg : node.args) prepare(arg, name_of_parts);
}

void Printer::declare(int index, const std::string& name_of_parts) {
  const Node& node = graph_[index];
  const std::string& base = node.named ? node.name : name_of_parts;
  for (const V& arg : node.args) prepare(arg, base);
  std::string name = node.named ? base : base + "_part";
  for (int i = 2; taken_.count(name) != 0; ++i) name = base + "_part" + std::to_string(i);
  taken_.insert(name);
  out_ += wrapped("  " + (node.vector ? dialect_.vector_type : dialect_.type) + ' ' + name + " = " +
                  operation(node).text + ';');
  names_[static_cast<std::size_t>(index)] = name;
}

void Printer::line(const Line& line) {
  const bool reached = line.value.is_constant() || uses_[static_cast<std::size_t>(line.value.node)] > 0;
  if (!reached) return comment("  " + line.target + " does not change the result");
  prepare(line.value, line.name);
  const std::string known = atom(line.value);
  if (known != line.name) comment("  " + line.target + " is " + known);
}

std::string Printer::text(const V& v, Strength least) {
  Text t = expression(v);
  return t.strength >= least ? std::move(t.text) : "(" + t.text + ")";
}

Printer::Text Printer::expression(const V& v) {
  if (v.is_constant()) return {std::to_string(v.constant), kAtom};
  const std::string& name = names_[static_cast<std::size_t>(v.node)];
  if (!name.empty()) return {name, kAtom};
  const Node& node = graph_[v.node];
  return operation(node);
}

Printer::Text Printer::operation(const Node& node) {
  const auto& [a, b, c, d] = node.args;
  switch (node.opcode) {
    case Opcode::input:
      inputs_.insert(node.name);
      return {node.name, kAtom};
    case Opcode::add:
      if (b.is_constant() && b.constant < 0) {
        return {text(a, kSum) + " - " + std::to_string(-b.constant), kSum};
      }
      return {text(a, kSum) + " + " + text(b, kProduct), kSum};
    case Opcode::sub:
      if (a.is_constant() && a.constant == 0) return {"-" + text(b, kAtom), kSum};
      return {text(a, kSum) + " - " + text(b, kProduct), kSum};
    case Opcode::mul:
      if (b.is_constant() && b.constant == -1) return {"-" + text(a, kAtom), kSum};
      return {text(a, kProduct) + " * " + text(b, kAtom), kProduct};
    case Opcode::divide:
      return {text(a, kProduct) + " / " + text(b, kAtom), kProduct};
    case Opcode::min_of:
      if (const Node* const inner = a.is_constant() ? nullptr : &graph_[a.node];
          inner != nullptr && inner->opcode == Opcode::max_of && !wants_name(a.node) && inner->args[1].is_constant() &&
          b.is_constant()) {
        return {call(dialect_.clamp, {inner->args[0], inner->args[1], b}), kAtom};
      }
      return {call(dialect_.min_of, {a, b}), kAtom};
    case Opcode::max_of:
      return {call(dialect_.max_of, {a, b}), kAtom};
    case Opcode::abs_of:
      return {call(dialect_.abs_of, {a}), kAtom};
    case Opcode::negate_where_negative:
      return {call(dialect_.with_sign, {a, b}), kAtom};
    case Opcode::select_where_at_least: {
      const auto branch = [&](const V& v) { return node.vector && !v.is_vector() ? vector(v) : text(v, kSum); };
      return {text(a, kSum) + " >= " + text(b, kSum) + " ? " + branch(c) + " : " + branch(d), kConditional};
    }
    case Opcode::sum_of_components:
      return {call(dialect_.sum_of_components, {a}), kAtom};
  }
  return {};
}

std::string Printer::call(const std::string& function, std::initializer_list<V> args) {
  called_.insert(function);
  std::string out = function + '(';
  for (const V& arg : args) out += (out.back() == '(' ? "" : ", ") + text(arg, kConditional);
  return out + ')';
}

void print_body(Printer& printer, const Listing& listing) {
  for (const Block& block : listing.blocks) {
    for (const std::string& text : block.comments) printer.comment(text);
    for (const Line& line : block.lines) printer.line(line);
    printer.blank();
  }
  for (const std::string& text : listing.final_comments) printer.comment(text);
  for (std::size_t i = 0; i < 4; ++i) {
    printer.prepare(listing.result[i], std::string("result_") + kComponentLetters[i]);
  }
}

std::string codes_comment(const Datapath& datapath) {
  const std::string one = std::to_string(datapath.one);
  return "// A register-combiner program in integers: " + one + " is 1.0, one half is " +
         std::to_string(datapath.half) + ". Arguments are register codes in [" + std::to_string(datapath.lowest) +
         ", " + one + "],\n// the result is codes in [0, " + one + ']';
}

std::string range_comment(const Printer& printer) {
  return "Every value below lies in [" + std::to_string(printer.range().low) + ", " +
         std::to_string(printer.range().high) + "]: 32 bits hold it. Only numbers that are not negative are divided.";
}

std::optional<Diagnostic> refusal(const Printer& printer, const Graph& graph) {
  constexpr std::int64_t kLowest = std::numeric_limits<std::int32_t>::min();
  constexpr std::int64_t kHighest = std::numeric_limits<std::int32_t>::max();
  if (printer.range().low > kLowest && printer.range().high <= kHighest && !graph.negative_division()) {
    return std::nullopt;
  }
  return Diagnostic{.message = "the profile's codes are too large for 32-bit integers"};
}

}  // namespace ninebit::emit
