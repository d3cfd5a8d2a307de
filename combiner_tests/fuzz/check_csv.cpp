// Tables for `eval`.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <climits>
#include <cstdlib>
#include <memory>

#include "combiner_tests/fuzz/checks.h"
#include "combiner_tests/fuzz/common.h"
#include "src/tools/input/eval_table.h"

namespace ninebit::fuzz {
namespace {

using tools::CsvLines;
using tools::EvalBatch;
using tools::EvalRows;
using tools::InputFile;

// Opens a file, or standard input, as the program does.
InputFile opened(const std::string& name) {
  auto file = InputFile::open(name);
  if (!file) std::abort();  // the machine's fault: no /proc
  return std::move(*file);
}

void write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count <= 0) std::abort();
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

// A file that is read at once.
InputFile whole(std::string_view text) {
  const int descriptor = ::memfd_create("table", MFD_CLOEXEC);
  if (descriptor < 0) std::abort();
  write_all(descriptor, text);
  InputFile file = opened("/proc/self/fd/" + std::to_string(descriptor));
  ::close(descriptor);
  return file;
}

// How many bytes of a text come at once from in_pieces(): a pipe holds 16 pieces at least.
std::size_t piece_of(std::size_t size) {
  return std::max(1 + size % 61, size / 15 + 1);
}

// A pipe in packet mode as standard input: each read gives what one write put in.
InputFile in_pieces(std::string_view text) {
  int ends[2] = {};
  if (::pipe2(ends, O_CLOEXEC | O_DIRECT) != 0) std::abort();
  const std::size_t piece = piece_of(text.size());
  for (std::size_t at = 0; at < text.size(); at += piece) write_all(ends[1], text.substr(at, piece));
  if (::dup2(ends[0], STDIN_FILENO) != STDIN_FILENO) std::abort();
  ::close(ends[0]);
  ::close(ends[1]);
  return opened("-");
}

// A table as it was understood: its columns and rows as text, and the fault that ended the reading.
struct Table {
  std::string text;
  std::string fault;  // "LINE:COLUMN: MESSAGE"
};

// "FILE:LINE:COLUMN" without the file, which has no colon here.
Table with_fault(Table table, const Diagnostic& why) {
  table.fault = why.file.substr(std::min(why.file.find(':') + 1, why.file.size())) + ": " + why.message;
  return table;
}

Table read(InputFile file, const HardwareProfile& profile) {
  CsvLines lines(std::move(file));
  Table table;
  const auto header = lines.next();
  if (!header) return with_fault(table, header.error());
  if (!*header) return table;
  const auto columns = tools::read_header(**header, lines.name(), profile);
  if (!columns) return with_fault(table, columns.error());
  for (const tools::EvalColumn& column : *columns) table.text += (table.text.empty() ? "" : ",") + column.name();
  table.text += '\n';
  const EvalRows rows(*columns, profile);
  const auto batch = std::make_unique<EvalBatch>();
  while (true) {
    rows.begin(*batch);
    std::size_t count = 0;
    while (count < kBatchSize) {
      const auto line = lines.next();
      if (!line) return with_fault(table, line.error());
      if (!*line) return table;
      if (const Status added = rows.add(**line, lines.name(), *batch); !added) return with_fault(table, added.error());
      const char* comma = "";
      for (const tools::EvalColumn& column : *columns) {
        table.text += comma + std::to_string(batch->registers(column.reg, column.component)[count]);
        comma = ",";
      }
      table.text += '\n';
      ++count;
    }
    rows.end(*batch);
    if (batch->count != kBatchSize) std::abort();
  }
}

std::string wrong_with_fault(const std::string& fault, std::string_view text) {
  TextPlace place{0, 0};
  const char* const end = fault.data() + fault.size();
  const auto line = std::from_chars(fault.data(), end, place.line);
  if (line.ptr == end || *line.ptr != ':') return "a fault without a place: " + fault;
  const auto column = std::from_chars(line.ptr + 1, end, place.column);
  const std::string_view message = std::string_view(fault).substr(static_cast<std::size_t>(column.ptr - fault.data()));
  if (!message.starts_with(": ")) return "a fault without a place: " + fault;
  return first_of(wrong_with_place(place, text), [&] { return wrong_with_message(message.substr(2)); });
}

std::string wrong_with_table(std::string_view text, const HardwareProfile& profile) {
  const Table table = read(whole(text), profile);
  if (piece_of(text.size()) <= PIPE_BUF) {  // else a write makes several packets
    const Table pieces = read(in_pieces(text), profile);
    if (pieces.text != table.text || pieces.fault != table.fault) {
      return "read in pieces it is another table:\n" + table.text + table.fault + "\n" + pieces.text + pieces.fault;
    }
  }
  const Table back = read(whole(table.text), profile);
  if (back.text != table.text || !back.fault.empty()) {
    return "written again it is another table:\n" + table.text + back.text + back.fault;
  }
  return table.fault.empty() ? "" : wrong_with_fault(table.fault, text);
}

}  // namespace

std::string check_csv(std::string_view bytes) {
  for (const HardwareProfile* const profile : kProfiles) {
    std::string wrong = wrong_with_table(bytes, *profile);
    if (!wrong.empty()) return wrong;
  }
  return {};
}

}  // namespace ninebit::fuzz
