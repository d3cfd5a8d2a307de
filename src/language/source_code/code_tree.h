// What the parsers of sources make: expressions and statements of C and Pascal alike.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ninebit::code {

// Deeper ones are not read: whoever walks them does so by recursion.
inline constexpr int kMostNestedStatements = 100, kMostNestedExpressions = 60, kMostChained = 400;

struct Expression {
  enum class Kind : std::uint8_t {
    unreadable,
    number,       // text
    text,         // a string literal, or several in a row: the bytes [offset, end) hold them, unless is_pasted
    name,         // text, without qualifiers; is_qualified
    unary,        // text is the operator; "post++" and "post--" after the operand
    binary,       // text is the operator, C's; two parts
    assignment,   // text is "=" or "+=", …; target and value; in a list kDesignatedElement: index and value
    conditional,  // three parts
    call,         // the callee, then the arguments
    index,        // the array and the index
    member,       // text is the member; the object
    list,         // { … }, or the arguments of a constructor
    cast          // text is the last word of the type; one part
  };
  Kind kind = Kind::unreadable;
  bool is_qualified = false;  // a name: with a class or a namespace before it
  bool is_pasted = false;     // a text: made by macros; text has its literals
  std::uint32_t offset = 0, end = 0;
  std::string_view text{};
  std::vector<Expression> parts{};
};

using ExpressionKind = Expression::Kind;
inline constexpr std::string_view kDesignatedElement = "[]=";

// One name of a declaration.
struct Declared {
  std::string_view name{};
  std::string_view type{};  // its last word, such as GLfloat
  std::uint32_t offset = 0;
  bool is_constant = false;
  bool is_array = false;
  std::vector<Expression> bounds{};  // of an array, as far as they are given
  std::vector<Expression> low{};     // Pascal: the first indices
  std::vector<Expression> value{};   // one or none
};

struct Statement {
  enum class Kind : std::uint8_t {
    nothing,
    expression,   // value
    declaration,  // declared
    block,        // body
    branch,       // value, body, otherwise
    loop,         // first, value (none: forever), step, body; tests_last
    each,         // declared (one, without a value), value, body: the body for each element of the value
    choice,       // value, body with labels
    label,        // value (none: default)
    leave,        // break
    next,         // continue
    give_back,    // return; value, if any
    jump,         // goto; message is the label
    unreadable    // message
  };
  Kind kind = Kind::nothing;
  bool tests_last = false;         // a loop
  bool is_repeated_until = false;  // a loop that ends when its value is true
  std::uint32_t offset = 0, end = 0;
  std::vector<Expression> value{};  // one or none
  std::vector<Expression> step{};   // one or none
  std::vector<Statement> first{};   // of a loop
  std::vector<Declared> declared{};
  std::vector<Statement> body{}, otherwise{};
  std::string message{};
};

using StatementKind = Statement::Kind;

struct Parameter {
  std::string_view name{};
  std::vector<Expression> value{};  // its default; one or none
};

// A function whose body stands in the file.
struct Function {
  std::string name{};                // with the class before it, if the source gives one
  std::string_view own_name{};       // the last part
  std::uint32_t offset = 0;          // of the name
  std::uint32_t begin = 0, end = 0;  // bytes of the body
  std::size_t first = 0, last = 0;   // tokens of the body, without its braces; in Pascal with its declarations
  std::size_t block = 0;             // Pascal: the token `begin`
  std::vector<Parameter> parameters{};
};

// An array type: the bounds of its dimensions and the last word of its elements' type.
struct ArrayType {
  std::vector<Expression> low{}, size{};  // `low` in Pascal alone
  std::string_view element{};
  bool is_array = false;
};

// The members of a struct in their order.
using Members = std::vector<std::string_view>;

struct Outline {
  std::vector<Function> functions{};
  std::vector<Statement> globals{};  // declarations outside of functions; also of classes
  std::vector<Statement> code{};     // statements outside of functions
  std::map<std::string_view, Members> structs{};
  std::set<std::string_view> unions{};        // types whose members share their place
  std::map<std::string, ArrayType> arrays{};  // array types by name; in Pascal, in lower case
  std::deque<std::string> names{};            // of structs without one
};

}  // namespace ninebit::code
