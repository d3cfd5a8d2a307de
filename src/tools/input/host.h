// A process that runs verbs without being the program: the Python module. It takes what the program would print, and
// pictures, texts and pages as values.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ninebit::tools {

// Samples in memory, the top row first.
struct HostArray {
  std::string name;
  char kind = 'B';                    // NumPy's letter: B, I (unsigned 8 and 32 bits), h (16 bits), e, f (16, 32 bits)
  std::vector<std::ptrdiff_t> shape;  // rows, columns, and components if there are several
  std::vector<std::ptrdiff_t> strides;  // in bytes
  const void* first = nullptr;
  std::shared_ptr<const void> owner;  // keeps the samples
};

class Host {
 public:
  Host() = default;
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;
  virtual ~Host() = default;

  // The file whose code runs, which identifies the build.
  [[nodiscard]] virtual std::filesystem::path code_file() const = 0;
  // Text for stderr: lines with their ends.
  virtual void say(std::string_view text) noexcept = 0;
  // Text for stdout.
  virtual void answer(std::string_view text) = 0;
  // Progress, 0 to 1. Any thread may call it.
  virtual void step(std::string_view what, double done) = 0;
  // Whether to end the work. Any thread may call it.
  [[nodiscard]] virtual bool stopped() const = 0;
  virtual void give(HostArray array) = 0;
  virtual void give(std::string name, std::string text) = 0;
};

// The host of this process; nullptr: it is the program. Only one host runs a verb at a time.
[[nodiscard]] Host* host() noexcept;
void set_host(Host* host) noexcept;

// The size of the reader's terminal, and text that fits it.

// Columns for lines of text on this standard stream: the environment variable COLUMNS if it is a whole number from 1
// to 10,000; else the terminal's width; else 80.
[[nodiscard]] int terminal_columns(int standard_stream);

// Code points of UTF-8 text.
[[nodiscard]] int width_of(std::string_view text);

// Breaks longer lines at spaces. Their rest is indented by 4 more than they are. A word that is too long stays whole.
[[nodiscard]] std::string wrapped(std::string_view text, int columns);

// Breaks lines at the width of this process's terminal, their rest at column `rest` where the lines leave room
// for it; as they are where standard output goes elsewhere and COLUMNS is not set. Examples of commands stay whole.
[[nodiscard]] std::string wrapped_for_terminal(std::string_view text, int rest);

}  // namespace ninebit::tools
