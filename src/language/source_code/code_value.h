// Values of a source's expressions: known, or the names of what would make them known; and where they are stored.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "src/language/source_code/code_tree.h"

namespace ninebit::code {

using Names = std::set<std::string, std::less<>>;

struct Value {
  enum class Kind : std::uint8_t {
    unknown,
    number,
    pointer,      // into `object`, or null
    record,       // a struct's cells
    text,         // string literals: the bytes [begin, end) of the source, or `name` if macros made them
    function,     // of the file
    entry_point,  // a function of OpenGL: true, and not NULL
    symbol        // a name that a definition gives as a value; equal to that name alone
  };
  Kind kind = Kind::unknown;
  Number number{};             // of an unknown value: the kinds it may have; 0: any
  int object = -1;             // of a pointer; of an unknown one the object that it points into, if that is known
  std::int64_t at = 0;         // of a pointer: the cell
  const Type* type = nullptr;  // of a pointer: what it points to; of a record: its struct
  std::shared_ptr<const std::vector<Value>> cells{};
  const Function* function = nullptr;
  std::uint32_t begin = 0, end = 0;
  std::string name{};  // of an unknown value that nothing changes: its name; of a symbol; of a text from macros
  std::shared_ptr<const Names> needs{};    // of an unknown value: what to define; none: its own name
  std::shared_ptr<const Names> origins{};  // of a known value: what was assumed for it

  [[nodiscard]] bool is(Kind one) const { return kind == one; }
  [[nodiscard]] bool is_known() const { return kind != Kind::unknown; }
  [[nodiscard]] bool is_number() const { return kind == Kind::number; }
};
using ValueKind = Value::Kind;

[[nodiscard]] Value number_value(const Number& number);
[[nodiscard]] Value integer_value(std::int64_t value);
[[nodiscard]] Value pointer_value(int object, std::int64_t at, const Type* type);
[[nodiscard]] Value record_value(const Type* type, std::span<const Value> cells);
// A value that is known if `name` is defined.
[[nodiscard]] Value needed_value(const std::string& name, Kinds kinds = 0);
// A value that is not known because these are not, or depend on what was assumed.
[[nodiscard]] Value unknown_of(const Value& a, const Value& b, Kinds kinds = 0);
// `value` with the assumptions of `other`, too.
[[nodiscard]] Value with_origins(Value value, const Value& other);
// Whether two values are the same, also in what makes them unknown.
[[nodiscard]] bool same(const Value& a, const Value& b);
// The value of a number that is, or may be, of an integer type; empty: it is something else.
[[nodiscard]] std::optional<std::int64_t> integer_of(const Value& value);
// Whether a value is true; empty: that is not known.
[[nodiscard]] std::optional<bool> truth(const Value& value);

// A variable, or what an expression created. Its cells are the numbers and pointers in it, in their order.
struct Object {
  std::vector<Value> cells{};
  std::vector<const Type*> types{};  // of the cells
  const Type* type = nullptr;        // of the whole
  std::string name{};
  bool is_constant = false;
  bool is_global = false;   // other functions of the file, and of other files, may change it
  bool is_escaped = false;  // functions of other files have its address
  bool is_static = false;   // it is there before any function runs
};

// Where a value is stored.
struct Place {
  enum class Kind : std::uint8_t {
    nowhere,    // not known: a store may change anything
    outside,    // in memory that no variable of the source is: `path` names it
    somewhere,  // in `object`
    cell        // at `at` of `object`
  };
  Kind kind = Kind::nowhere;
  int object = -1;
  std::int64_t at = 0;
  const Type* type = nullptr;
  std::string path{};                    // as the source writes it
  std::string outside{};                 // of memory outside: its name
  std::shared_ptr<const Names> needs{};  // where it is not known: what to define
};
using PlaceKind = Place::Kind;

// A cell by its object, or memory outside by its name.
using CellKey = std::tuple<int, std::int64_t, std::string>;
using Changes = std::map<CellKey, Value>;

// A type that says nothing of what it has.
[[nodiscard]] inline bool is_vague(const Type* type) {
  return type == nullptr || type->is(TypeKind::unknown) || type->is(TypeKind::nothing);
}
[[nodiscard]] inline bool is_whole(const Type* type) {
  return type->is(TypeKind::array) || type->is(TypeKind::structure);
}
void add_cell_types(const Type* type, std::vector<const Type*>& out);
// The bytes of a type; 0: not known.
[[nodiscard]] std::int64_t bytes_of(const Type* type);

}  // namespace ninebit::code
