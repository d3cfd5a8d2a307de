#include <gtest/gtest.h>
#include <ninebit/shadow/picture_files.h>

#include <filesystem>
#include <string>

TEST(Examples, PictureFiles) {
  using namespace ninebit;
  const Result<Scene> scene = complete_scene(*read_scene("scenes/index_room.gltf"), {}, 4.0F / 3.0F);
  const RenderSettings settings{.width = 160, .height = 120, .map_size = 64};
  const Result<Rendering> rendering = find_technique("index-cube")->render(*scene, settings, {});
  ASSERT_TRUE(rendering.ok());
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "ninebit_pictures";
  Result<StagedFiles> files = StagedFiles::open(folder);
  ASSERT_TRUE(write_rendering(*rendering, *files).ok());
  ASSERT_TRUE(files->commit().ok());
  for (const std::string& name : file_names(*rendering, NamedFiles::unasked))
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  std::filesystem::remove_all(folder);
}
