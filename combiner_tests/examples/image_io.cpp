#include <gtest/gtest.h>
#include <ninebit/image/image_io.h>

#include <filesystem>

TEST(Examples, ImageIo) {
  using namespace ninebit;
  const Image8 image{.width = 2, .height = 1, .channels = 3, .pixels = {255, 0, 0, 0, 0, 255}};
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "ninebit_red_blue.png";
  const Status written = write_png(file, image);
  ASSERT_TRUE(written.ok()) << written.error().text();
  EXPECT_EQ(std::filesystem::file_size(file), encode_png(image)->size());
  std::filesystem::remove(file);
}
