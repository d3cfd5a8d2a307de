#include "src/playground/reply.h"

#include <algorithm>
#include <utility>

#include "src/system/lines.h"

namespace ninebit::playground {
namespace {

Json fault_object(const TextFault& fault) {
  Json object{{"message", fault.message}};
  if (!fault.file.empty()) object["file"] = fault.file;
  if (fault.line > 0) object["line"] = fault.line;
  if (fault.line > 0 && fault.column > 0) object["column"] = fault.column;
  return object;
}

}  // namespace

std::string text_of(const Json& object) {
  return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string text_of(const Reply& reply) {
  if (reply) return text_of(*reply);
  Json fault = fault_object(reply.faults().front());
  for (std::size_t i = 1; i < reply.faults().size(); ++i) fault["others"].push_back(fault_object(reply.faults()[i]));
  return text_of(Json{{"fault", std::move(fault)}});
}

Reply refusal(std::string message, std::string file, TextPlace place) {
  TextFault fault;
  fault.message = std::move(message);
  fault.file = std::move(file);
  fault.line = place.line;
  fault.column = place.column;
  return std::vector{std::move(fault)};
}

Reply refusal(const Diagnostic& fault) {
  return refusal(fault.message, fault.file, {fault.line, 0});
}

Reply refusals(std::vector<TextFault> faults, std::string_view text) {
  for (TextFault& fault : faults) fault.column = utf16_column(text, fault.line, fault.column);
  return faults;
}

int utf16_length(std::string_view bytes) {
  int units = 0;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) != 0x80U) units += byte >= 0xF0U ? 2 : 1;
  }
  return units;
}

std::string_view line_of(std::string_view text, int line) {
  std::string_view found;
  for (int i = 0; i < line; ++i) found = take_line(text);
  return found;
}

int utf16_column(std::string_view text, int line, int column) {
  if (line < 1 || column < 1) return column;
  const std::string_view before = line_of(text, line).substr(0, static_cast<std::size_t>(column - 1));
  return utf16_length(before) + 1 + std::max(0, column - 1 - static_cast<int>(before.size()));
}

}  // namespace ninebit::playground
