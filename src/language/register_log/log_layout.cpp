#include "src/language/register_log/log_layout.h"

#include <algorithm>

#include "src/language/register_log/log_methods.h"
#include "src/language/source/source_faults.h"

namespace ninebit::reglog {
namespace {

constexpr std::size_t kHeaderAmong = 32;  // lines that may be a header
constexpr std::uint32_t kBeyondMethods = 0x2000;

// Best first: a log may have an address in the push buffer beside the method.
constexpr std::string_view kMethodNamesOfColumns[] = {"method", "mthd",    "reg",  "register", "op",
                                                      "offset", "address", "addr", "name",     "method_name"};
constexpr std::string_view kDataNames[] = {"data",     "value", "val",   "param", "parameter",
                                           "argument", "arg",   "dword", "word"};
constexpr std::string_view kClassNames[] = {"class", "graphics_class", "object_class", "object", "obj"};
constexpr std::string_view kFrameNames[] = {"frame", "frame_number"};
// Other columns that tables have.
constexpr std::string_view kOtherNames[] = {"line",       "index", "number", "no",      "nr",    "time", "timestamp",
                                            "subchannel", "subch", "subc",   "channel", "count", "type", "size"};

// The column with the first of the names that a header has.
template <class List>
std::optional<std::size_t> column_named(const std::vector<std::string>& header, const List& names) {
  for (const std::string_view name : names) {
    const auto found = std::find(header.begin(), header.end(), name);
    if (found != header.end()) return static_cast<std::size_t>(found - header.begin());
  }
  return std::nullopt;
}

template <class List>
bool is_one_of(std::string_view word, const List& names) {
  return std::find(std::begin(names), std::end(names), word) != std::end(names);
}

// Whether words between blanks are the names of columns, and not a sentence with some of them.
bool are_names(const std::vector<std::string>& words) {
  return std::all_of(words.begin(), words.end(), [](const std::string& word) {
    return is_one_of(word, kMethodNamesOfColumns) || is_one_of(word, kDataNames) || is_one_of(word, kClassNames) ||
           is_one_of(word, kFrameNames) || is_one_of(word, kOtherNames);
  });
}

std::vector<std::string> header_of(std::string_view line, char separator) {
  std::vector<LogToken> tokens;
  split_line(line, separator, tokens);
  std::vector<std::string> header;
  for (const LogToken& token : tokens) {
    std::string_view text = token.text;
    while (!text.empty() && text.front() == '#') text.remove_prefix(1);
    while (!text.empty() && detail::is_blank(text.front())) text.remove_prefix(1);
    header.push_back(detail::lower_case(text));
    if (text.empty() && separator == 0) header.pop_back();
  }
  return header;
}

// How a token looks as a method: 0 not, 1 possible, 2 one that this reader needs. Bare decimal numbers are not.
int method_rank(std::string_view token, ChipClass chip) {
  std::optional<std::uint32_t> number;
  if (is_log_name(token) && !(token.size() >= 3 && is_hex_digits(token))) {
    number = token.find('_') == std::string_view::npos ? std::nullopt : number_of(token, chip);
    if (!number)
      return token.find("NV") != std::string_view::npos && token.find('_') != std::string_view::npos ? 1U : 0U;
  } else if (has_hex_prefix(token) || (is_hex_digits(token) && token.size() >= 3)) {
    number = number_in(token, true);
  }
  if (!number || *number == 0 || *number >= kBeyondMethods || *number % 4 != 0) return 0;
  return method_of(*number, chip).kind == MethodKind::none ? 1 : 2;
}

bool looks_hexadecimal(std::string_view token) {
  return has_hex_prefix(token) || (token.size() >= 3 && is_hex_digits(token));
}

bool is_number(std::string_view token) {
  return has_hex_prefix(token) ? number_in(token, true).has_value() : token.size() <= 10 && is_hex_digits(token);
}

// Whether the first line that is not a comment has the names of columns, and no numbers: those of another table, where
// by_header() finds none.
bool has_other_header(const std::vector<std::string_view>& lines) {
  const auto first = std::find_if(lines.begin(), lines.end(), [](std::string_view line) {
    const auto begin = std::find_if_not(line.begin(), line.end(), detail::is_blank);
    return begin != line.end() && *begin != '#';
  });
  if (first == lines.end()) return false;
  const auto is_name = [](const std::string& word) {
    return !word.empty() && !detail::is_digit(word.front()) && !looks_hexadecimal(word);
  };
  for (const char separator : {'\t', ',', ';', '|'}) {
    const std::vector<std::string> header = header_of(*first, separator);
    if (header.size() > 1 && std::all_of(header.begin(), header.end(), is_name)) return true;
  }
  return false;
}

// Statistics of one column of the lines.
struct ColumnCounts {
  std::size_t methods = 0, needed = 0, numbers = 0, hexadecimal = 0, classes = 0;
};

}  // namespace

std::optional<LogLayout> LogLayout::choose(const std::vector<std::string_view>& lines, ChipClass chip) {
  if (auto layout = by_header(lines)) {
    layout->find_bases(lines, chip);
    return layout;
  }
  const auto known = std::count_if(lines.begin(), lines.end(),
                                   [](std::string_view line) { return read_known_line(line).has_value(); });
  // Where most lines have a known form, columns are not looked for.
  if (2 * known >= std::ssize(lines) && known > 0) return LogLayout();
  // The members of a printed structure, "name = {" or "{", are not columns.
  const auto is_structure = [](std::string_view line) {
    const std::size_t brace = line.find('{');
    if (brace == std::string_view::npos) return false;
    const std::size_t before = line.substr(0, brace).find_last_not_of(" \t");
    return before == std::string_view::npos || line[before] == '=';
  };
  auto layout = std::any_of(lines.begin(), lines.end(), is_structure) ? std::nullopt : by_columns(lines, chip);
  if (!layout) return known > 0 ? std::optional(LogLayout()) : std::nullopt;
  layout->find_bases(lines, chip);
  const auto fitting = std::count_if(lines.begin(), lines.end(),
                                     [&](std::string_view line) { return layout->read_columns(line).has_value(); });
  if (known >= fitting) return LogLayout();
  layout->known_ = known > 0;
  return layout;
}

std::optional<LogLayout> LogLayout::by_header(const std::vector<std::string_view>& lines) {
  for (std::size_t i = 0; i < std::min(lines.size(), kHeaderAmong); ++i) {
    for (const char separator : {'\t', ',', ';', '|', '\0'}) {
      if (separator != 0 && lines[i].find(separator) == std::string_view::npos) continue;
      const std::vector<std::string> header = header_of(lines[i], separator);
      const auto method = column_named(header, kMethodNamesOfColumns), data = column_named(header, kDataNames);
      if (!method || !data) continue;
      // A line of a log may have these words, too, but it has numbers beside them.
      if (std::any_of(header.begin(), header.end(), [](const std::string& word) { return has_hex_prefix(word); }))
        continue;
      if (separator == 0 && !are_names(header)) continue;
      LogLayout layout;
      layout.known_ = false;
      layout.columns_ = true;
      layout.separator_ = separator;
      layout.header_ = i;
      layout.method_.at = *method;
      layout.data_.at = *data;
      if (const auto at = column_named(header, kClassNames)) layout.object_class_ = Column{*at, true};
      if (const auto at = column_named(header, kFrameNames)) layout.frame_ = Column{*at, false};
      return layout;
    }
  }
  return std::nullopt;
}

std::optional<LogLayout> LogLayout::by_columns(const std::vector<std::string_view>& lines, ChipClass chip) {
  std::vector<LogToken> tokens;
  std::vector<ColumnCounts> counts(kMostTokens);
  for (const std::string_view line : lines) {
    split_line(line, 0, tokens);
    for (std::size_t c = 0; c < tokens.size(); ++c) {
      const int rank = method_rank(tokens[c].text, chip);
      counts[c].methods += rank > 0 ? 1U : 0U;
      counts[c].needed += rank > 1 ? 1U : 0U;
    }
  }
  // The method's column: most that this reader needs, then most that are possible.
  const auto method = std::max_element(counts.begin(), counts.end(), [](const ColumnCounts& a, const ColumnCounts& b) {
    return a.needed != b.needed ? a.needed < b.needed : a.methods < b.methods;
  });
  if (method->needed == 0) return std::nullopt;
  LogLayout layout;
  layout.columns_ = true;
  layout.method_.at = static_cast<std::size_t>(method - counts.begin());
  std::size_t fitting = 0;
  bool decimal = true;
  for (const std::string_view line : lines) {
    split_line(line, 0, tokens);
    if (layout.method_.at >= tokens.size() || method_rank(tokens[layout.method_.at].text, chip) == 0) continue;
    ++fitting;
    const std::string_view found = tokens[layout.method_.at].text;
    decimal = decimal && std::all_of(found.begin(), found.end(), detail::is_digit);
    for (std::size_t c = 0; c < tokens.size(); ++c) {
      const std::string_view text = tokens[c].text;
      counts[c].numbers += is_number(text) ? 1U : 0U;
      counts[c].hexadecimal += is_number(text) && looks_hexadecimal(text) ? 1U : 0U;
      const auto number = number_in(text, true);
      counts[c].classes += number && chip_of_class(*number) && looks_hexadecimal(text) ? 1U : 0U;
    }
  }
  if (decimal && has_other_header(lines)) return std::nullopt;
  // The data's column: most numbers, then most in hexadecimal, then the nearest one behind the method.
  std::optional<std::size_t> data;
  const auto order = [&](std::size_t c) { return c > layout.method_.at ? c - layout.method_.at : kMostTokens + c; };
  for (std::size_t c = 0; c < counts.size(); ++c) {
    if (c == layout.method_.at || counts[c].numbers == 0) continue;
    const ColumnCounts& one = counts[c];
    const ColumnCounts& best = counts[data.value_or(c)];
    const bool better = one.numbers != best.numbers           ? one.numbers > best.numbers
                        : one.hexadecimal != best.hexadecimal ? one.hexadecimal > best.hexadecimal
                                                              : order(c) < order(data.value_or(c));
    if (!data || better) data = c;
  }
  if (!data) return std::nullopt;
  layout.data_.at = *data;
  layout.guess_ =
      "method in column " + std::to_string(layout.method_.at + 1) + ", data in column " + std::to_string(*data + 1);
  for (std::size_t c = 0; c < counts.size(); ++c) {
    if (c == *data || c == layout.method_.at || 2 * counts[c].classes <= fitting) continue;
    layout.object_class_ = Column{c, true};
    layout.guess_ += ", class in column " + std::to_string(c + 1);
    break;
  }
  return layout;
}

// Whether the numbers without 0x of the columns are hexadecimal.
void LogLayout::find_bases(const std::vector<std::string_view>& lines, ChipClass chip) {
  std::size_t as_hexadecimal = 0, as_decimal = 0, bare_data = 0, eight = 0;
  bool letters = false, zeros = false;
  for (std::size_t i = header_ ? *header_ + 1 : 0; i < lines.size(); ++i) {
    split_line(lines[i], separator_, tokens_);
    if (std::max(method_.at, data_.at) >= tokens_.size()) continue;
    const std::string_view method = tokens_[method_.at].text, data = tokens_[data_.at].text;
    if (!header_ && method_rank(method, chip) == 0) continue;
    if (is_hex_digits(method)) {
      const auto is_needed = [&](bool hexadecimal) {
        const auto number = number_in(method, hexadecimal);
        return number && method_of(*number, chip).kind != MethodKind::none;
      };
      as_hexadecimal += is_needed(true) ? 1U : 0U;
      as_decimal += is_needed(false) ? 1U : 0U;
    }
    if (!is_hex_digits(data)) continue;
    ++bare_data;
    eight += data.size() == 8 ? 1U : 0U;
    letters = letters || std::any_of(data.begin(), data.end(), [](char c) { return !detail::is_digit(c); });
    zeros = zeros || (data.size() > 1 && data.front() == '0');
  }
  method_.hexadecimal = as_hexadecimal >= as_decimal;
  data_.hexadecimal = bare_data == 0 || letters || zeros || eight == bare_data;
  if (!guess_.empty() && bare_data > 0) guess_ += data_.hexadecimal ? " (hexadecimal)" : " (decimal)";
}

std::optional<LogWrite> LogLayout::read(std::string_view line) {
  wrong_ = {};
  if (known_) {
    if (auto write = read_known_line(line)) return write;
  }
  return columns_ ? read_columns(line) : std::nullopt;
}

std::optional<LogWrite> LogLayout::read_columns(std::string_view line) {
  split_line(line, separator_, tokens_);
  const bool blank = std::all_of(line.begin(), line.end(), detail::is_blank) || line.front() == '#';
  const auto refuse = [&](std::string message, int column) -> std::optional<LogWrite> {
    if (header_ && !blank) wrong_ = {std::move(message), column};
    return std::nullopt;
  };
  if (method_.at >= tokens_.size()) {
    return refuse("the line has " + std::to_string(tokens_.size()) + " columns; expected a method in column " +
                      std::to_string(method_.at + 1),
                  1);
  }
  const LogToken& method = tokens_[method_.at];
  LogWrite write;
  write.column = method.column;
  if (const auto number = number_in(method.text, method_.hexadecimal)) {
    write.method = *number;
  } else if (is_log_name(method.text) && (header_ || method.text.find('_') != std::string_view::npos)) {
    write.name = method.text;
  } else {
    return refuse(detail::quoted(method.text) + " is not a method; expected one such as 0x0ac0 or " +
                      "NV097_SET_COMBINER_COLOR_ICW[0]",
                  method.column);
  }
  const LogToken data = data_.at < tokens_.size() ? tokens_[data_.at] : LogToken{{}, method.column};
  write.data = number_in(data.text, data_.hexadecimal);
  if (!write.data && header_ && !data.text.empty() && data.text.find("NO_DATA") == std::string_view::npos) {
    wrong_ = {detail::quoted(data.text) + " in column " + std::to_string(data_.at + 1) +
                  " is not a number of 32 bits; expected data such as 0x08040000",
              data.column};
  }
  // Free text has lines that are no writes: without data such a line is none.
  if (!write.data && !header_) return std::nullopt;
  if (object_class_ && object_class_->at < tokens_.size()) {
    write.object_class = number_in(tokens_[object_class_->at].text, true);
  }
  if (frame_ && frame_->at < tokens_.size()) write.frame = number_in(tokens_[frame_->at].text, false);
  return write;
}

}  // namespace ninebit::reglog
