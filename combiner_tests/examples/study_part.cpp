#include <gtest/gtest.h>
#include <ninebit/study/depth_packing_error.h>
#include <ninebit/study/study_part.h>

#include <filesystem>
#include <vector>

TEST(Examples, StudyPart) {
  using namespace ninebit;
  const auto study = make_depth_packing_study(
      {.packings = {"rgba8-mod"}, .storages = {ChannelStorage::round}, .sets = {DepthSet::bits16}});
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "ninebit_parts";
  std::filesystem::create_directories(folder);
  std::vector<StudyPart> parts;
  for (std::size_t i = 1; i <= 2; ++i) {  // on two machines
    const Result<StudyPart> part = run_part(**study, "build 1", {.index = i, .count = 2}, folder, {}, {});
    ASSERT_TRUE(part.ok()) << part.error().text();
    parts.push_back(*part);
  }
  EXPECT_TRUE(join_parts(parts).ok());
  std::filesystem::remove_all(folder);
}
