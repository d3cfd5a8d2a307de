#include "src/tools/common/page_file.h"

#include "src/tools/common/output_file.h"

namespace ninebit::tools {

CLI::Option* add_page_flag(CLI::App& verb, std::string& output) {
  return verb
      .add_option("-o,--output", output, "Write a page with a diagram to this file, instead of text to standard output")
      ->type_name("FILE.html");
}

Status write_page(const std::string& path, const DiagramPage& page) {
  return write_output(path, diagram_page(page));
}

}  // namespace ninebit::tools
