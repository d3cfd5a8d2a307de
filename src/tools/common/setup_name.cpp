#include "src/tools/common/setup_name.h"

#include <filesystem>
#include <system_error>

#include "src/system/inside_folder.h"

namespace ninebit::tools {

SetupName setup_name(const std::string& name) {
  const std::string_view file = posix::without_setup(name);
  std::error_code error;
  if (file.size() == name.size() || std::filesystem::exists(name, error)) return {name};
  return {std::string(file), std::stoul(name.substr(file.size() + 1))};
}

}  // namespace ninebit::tools
