// The parser's result: types, expressions, statements, functions.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "src/language/c_like/c_number.h"

namespace ninebit::code {

// Deeper ones are not read: whoever walks them does so by recursion.
inline constexpr int kMostNestedStatements = 100, kMostNestedExpressions = 60, kMostChained = 400;

struct Struct;

struct Type {
  enum class Kind : std::uint8_t {
    unknown,    // a class of another file, an array of unknown size
    nothing,    // void
    number,     // kinds
    pointer,    // of
    array,      // of, count
    structure,  // structure
    function,   // of: its result
    opaque      // what is not modelled: unions, bit-fields, volatile variables; its value is never known
  };
  Kind kind = Kind::unknown;
  Kinds kinds = 0;
  const Type* of = nullptr;
  std::int64_t count = 0;  // kOpen: as many as the initializer has
  const Struct* structure = nullptr;
  std::string_view name{};  // of an unknown class

  static constexpr std::int64_t kOpen = -1;
  [[nodiscard]] bool is(Kind one) const { return kind == one; }
};
using TypeKind = Type::Kind;

struct Member {
  std::string_view name{};
  const Type* type = nullptr;
  std::size_t cell = 0;  // its first cell in the struct
};

struct Struct {
  std::string_view name{};
  std::vector<Member> members{};
  std::size_t cells = 0;
  bool is_complete = false;
  bool is_special = false;    // it has constructors, operators, a destructor or a base: copies are not modelled
  bool is_destroyed = false;  // it has a destructor
};

// How many numbers and pointers a variable of a type has in it.
[[nodiscard]] std::size_t cells_of(const Type* type);

struct Expression {
  enum class Kind : std::uint8_t {
    unreadable,
    number,       // number
    text,         // string literals: the bytes [offset, end) hold them, unless is_made: then text has them
    name,         // text; qualifier, if there is one
    unary,        // text is the operator: - + ! ~ * & ++ -- post++ post--
    binary,       // text is the operator; && and ||, too
    assignment,   // text is = or += …; the target and the value
    conditional,  // three parts
    comma,        // two parts
    call,         // the callee, then the arguments
    index,        // the array and the index
    member,       // text is the member; the object; is_arrow
    list,         // { … }
    designated,   // of a list: text is a member's name, or the first of two parts an index; the value is the last part
    cast,         // type; one part
    size,         // sizeof: of type, or of one part
    make          // type: Type(…), new Type[…], (Type){…}; is_new
  };
  Kind kind = Kind::unreadable;
  bool is_made = false, is_arrow = false, is_new = false;
  std::uint32_t offset = 0, end = 0;
  std::string_view text{}, qualifier{};
  Number number{};
  const Type* type = nullptr;
  std::vector<Expression> parts{};
};
using ExpressionKind = Expression::Kind;

// One name of a declaration.
struct Declared {
  std::string_view name{};
  std::string_view scope{};  // of a member: its class
  const Type* type = nullptr;
  std::uint32_t offset = 0;
  bool is_constant = false, is_static = false, is_reference = false, is_extern = false;
  std::vector<Expression> value{};  // one or none
  bool is_constructed = false;      // the value is the list of a constructor's arguments
};

struct Statement {
  enum class Kind : std::uint8_t {
    nothing,
    expression,   // value
    declaration,  // declared
    block,        // body; message is try if what it throws is caught
    branch,       // value, body, otherwise
    loop,         // first, value (none: forever), step, body; tests_last
    each,         // declared (one, without a value), value, body: the body for each element of the value
    choice,       // value, body with labels
    label,        // of a choice: value (none: default)
    mark,         // message is the label of a goto
    leave,        // break
    next,         // continue
    give_back,    // return, or throw as its message says; value, if any
    jump,         // goto; message is the label
    unreadable    // message
  };
  Kind kind = Kind::nothing;
  bool tests_last = false;  // a loop
  bool may_jump = false;    // unreadable: it may leave the block
  std::uint32_t offset = 0, end = 0;
  std::vector<Expression> value{};  // one or none
  std::vector<Expression> step{};   // one or none
  std::vector<Statement> first{};   // of a loop
  std::vector<Declared> declared{};
  std::vector<Statement> body{}, otherwise{};
  std::string message{};
};
using StatementKind = Statement::Kind;

// A function of the file; without a body, its declaration.
struct Function {
  std::string name{};                // with the class before it, if the source gives one
  std::string_view own_name{};       // the last part
  std::string_view scope{};          // the class
  std::uint32_t offset = 0;          // of the name
  std::uint32_t begin = 0, end = 0;  // bytes of the body
  std::size_t first = 0, last = 0;   // tokens of the body, without its braces; none: `last` is 0
  const Type* result = nullptr;
  bool is_template = false, is_variadic = false, is_special = false;  // special: a constructor with initializers
  std::vector<Declared> parameters{};
};

struct Outline {
  std::deque<Function> functions{};   // with bodies
  std::deque<Function> prototypes{};  // without
  std::vector<Statement> globals{};   // declarations outside of functions, also of classes
  std::vector<Statement> code{};      // statements outside of functions
  std::deque<Type> types{};
  std::deque<Struct> structs{};
};

}  // namespace ninebit::code
