// Java's buffers of numbers, which its bindings of OpenGL take in place of arrays.
#include <utility>

#include "src/language/source_code/code_machine.h"

namespace ninebit::code {
namespace {

// Whether a function makes a buffer, by its name: createFloatBuffer, newDirectFloatBuffer, asFloatBuffer, allocate, …
bool makes_buffer(std::string_view name) {
  return name.ends_with("FloatBuffer") || name.ends_with("IntBuffer") || name == "allocate";
}

// The variable that a chain of calls such as buffer.put(1).put(2) begins with.
const Expression& first_of_chain(const Expression& e) {
  const Expression* at = &e;
  while (at->kind == ExpressionKind::call && at->parts[0].kind == ExpressionKind::member) at = &at->parts[0].parts[0];
  return *at;
}

}  // namespace

// Empty: the call is none of a buffer's.
std::optional<Value> Machine::call_buffer(std::string_view name, const Expression& e) {
  const std::size_t count = e.parts.size() - 1;
  const Expression& callee = e.parts[0];
  if (makes_buffer(name) && count <= 1) {
    Value out;
    out.kind = Value::Kind::list;
    if (count == 0) return out;
    Value content = evaluate(e.parts[1]);
    if (content.kind == Value::Kind::list) return content;
    return content.is_known() ? out : std::optional<Value>();
  }
  const bool puts = name == "put" && (count == 1 || count == 2);
  const bool rewinds = (name == "flip" || name == "rewind") && count == 0;
  if (callee.kind != ExpressionKind::member || (!puts && !rewinds)) return std::nullopt;
  Value content = evaluate(callee.parts[0]);
  if (content.kind != Value::Kind::list) return std::nullopt;
  if (puts && count == 2) {
    const Value index = evaluate(e.parts[1]);
    const auto at = static_cast<std::size_t>(index.integer);
    if (index.kind != Value::Kind::integer || index.integer < 0 || at >= kMostElements) return std::nullopt;
    if (at >= content.list.size()) content.list.resize(at + 1);
    content.list[at] = evaluate(e.parts[2]);
  } else if (puts) {
    Value more = evaluate(e.parts[1]);
    if (more.kind != Value::Kind::list) {
      content.list.push_back(std::move(more));
    } else {
      content.list.insert(content.list.end(), more.list.begin(), more.list.end());
    }
    if (content.list.size() > kMostElements) return std::nullopt;
  }
  if (Value* const buffer = place(first_of_chain(callee.parts[0]))) *buffer = content;
  return content;
}

}  // namespace ninebit::code
