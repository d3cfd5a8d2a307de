// Reads the tables of this folder: values taken from pictures of real hardware. Lines that begin with # name the
// source.
#pragma once

#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace ninebit::test {

inline std::vector<std::string> split_csv_line(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

// A row by column name.
using HardwareRow = std::map<std::string, std::string>;

// The rows of combiner_tests/hardware/NAME.csv. Throws std::runtime_error on a file that is
// missing, empty or has a row of another length than its header.
inline std::vector<HardwareRow> read_hardware_table(const std::string& name) {
  const std::string path = std::string(NINEBIT_SOURCE_DIR) + "/combiner_tests/hardware/" + name + ".csv";
  std::ifstream file(path);
  std::vector<std::string> header;
  std::vector<HardwareRow> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::vector<std::string> fields = split_csv_line(line);
    if (header.empty()) {
      header = fields;
      continue;
    }
    if (fields.size() != header.size()) throw std::runtime_error(path + ": a row of another length: " + line);
    HardwareRow row;
    for (std::size_t i = 0; i < fields.size(); ++i) row[header[i]] = fields[i];
    rows.push_back(row);
  }
  if (rows.empty()) throw std::runtime_error(path + ": no rows");
  return rows;
}

}  // namespace ninebit::test
