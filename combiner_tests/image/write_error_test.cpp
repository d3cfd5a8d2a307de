// Full disks and other places that cannot be written: every writer says so and leaves nothing behind.

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "combiner_tests/image/read_back.h"
#include "combiner_tests/image/rows.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/image/image_io.h"

namespace {

using image_test::rows_of;
using image_test::scramble;
using image_test::TempFolder;
using ninebit::ExrChannel;
using ninebit::ExrPart;
using ninebit::Image8;
using ninebit::Status;

namespace fs = std::filesystem;

struct Writer {
  std::string name;
  std::function<Status(const fs::path&)> write;
};

Status write_noisy_png(const fs::path& file, int size) {
  Image8 image{size, size, 4, {}};
  for (int i = 0; i < size * size * 4; ++i) {
    image.pixels.push_back(static_cast<std::uint8_t>(scramble(static_cast<std::uint32_t>(i))));
  }
  return ninebit::write_png(file, image);
}

std::vector<std::uint32_t> noise(int size) {
  std::vector<std::uint32_t> plane(static_cast<std::size_t>(size * size));
  for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = scramble(static_cast<std::uint32_t>(i));
  return plane;
}

Status write_noisy_parts(const fs::path& file, int size) {
  const std::vector<std::uint32_t> plane = noise(size);
  const std::vector<float> reals(plane.begin(), plane.end());
  const std::vector<ExrPart> parts = {{"a", size, size, {{"index", rows_of(plane, size)}}},
                                      {"b", size, size, {{"R", rows_of(reals, size)}}}};
  return ninebit::write_exr_parts(file, parts);
}

Status write_noisy_cube(const fs::path& file, int size) {
  const std::vector<std::uint32_t> plane = noise(size);
  std::array<std::vector<ExrChannel>, 6> faces;
  faces.fill({{"index", rows_of(plane, size)}});
  return ninebit::write_exr_cube(file, size, faces);
}

// Small ones fit a writer's buffer, so that only closing fails; large ones fail in the middle.
std::vector<Writer> writers() {
  std::vector<Writer> all;
  for (const int size : {4, 400}) {
    all.push_back({"png " + std::to_string(size), [size](const fs::path& f) { return write_noisy_png(f, size); }});
    all.push_back({"parts " + std::to_string(size), [size](const fs::path& f) { return write_noisy_parts(f, size); }});
    all.push_back({"cube " + std::to_string(size), [size](const fs::path& f) { return write_noisy_cube(f, size); }});
  }
  return all;
}

void expect_cannot_write(const Status& status, const fs::path& file, const std::string& what) {
  ASSERT_FALSE(status.ok()) << what;
  EXPECT_EQ(status.error().fault, ninebit::Fault::cannot_write) << what;
  EXPECT_EQ(status.error().file, file.string()) << what;
  EXPECT_FALSE(status.error().message.empty()) << what;
}

TEST(WriteErrors, NoByteMayBeMissing) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  for (const Writer& writer : writers()) {
    const TempFolder folder;
    const fs::path file = folder.path() / "a.bin";
    ASSERT_TRUE(writer.write(file).ok()) << writer.name;
    const std::string whole = image_test::read_bytes(file);
    ASSERT_GT(whole.size(), 20U);
    fs::remove(file);
    std::vector<std::uint64_t> limits = {0, 1, whole.size() - 1};
    for (std::uint64_t step = 1; step < 12; ++step) limits.push_back(whole.size() * step / 12);
    for (const std::uint64_t limit : limits) {
      const std::string what = writer.name + " cut at " + std::to_string(limit) + " of " + std::to_string(whole.size());
      std::optional<Status> status;
      {
        const image_test::FileSizeLimit full(limit);
        status = writer.write(file);
      }
      expect_cannot_write(*status, file, what);
      EXPECT_TRUE(folder.names().empty()) << what;
    }
    {
      const image_test::FileSizeLimit just_enough(whole.size());
      EXPECT_TRUE(writer.write(file).ok()) << writer.name;
    }
    EXPECT_TRUE(image_test::read_bytes(file) == whole) << writer.name;
  }
}

TEST(WriteErrors, AFullDeviceIsReportedAndStays) {
  if (!fs::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  for (const Writer& writer : writers()) {
    expect_cannot_write(writer.write("/dev/full"), "/dev/full", writer.name);
    ASSERT_TRUE(fs::is_character_file("/dev/full")) << writer.name << " removed the device";
  }
}

TEST(WriteErrors, PlacesWhereNoFileCanBe) {
  const TempFolder folder;
  image_test::write_bytes(folder.path() / "file", "content");
  fs::create_directory(folder.path() / "folder.png");
  for (const Writer& writer : writers()) {
    for (const fs::path& file : {folder.path() / "missing" / "a.png", folder.path() / "file" / "a.png",
                                 folder.path() / "folder.png", fs::path("/proc/ninebit.png"), fs::path()}) {
      testing::internal::CaptureStderr();
      testing::internal::CaptureStdout();
      const Status status = writer.write(file);
      EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
      EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
      expect_cannot_write(status, file, writer.name + " to " + file.string());
    }
  }
  EXPECT_EQ(image_test::read_bytes(folder.path() / "file"), "content");
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"file", "folder.png"}));
}

}  // namespace
