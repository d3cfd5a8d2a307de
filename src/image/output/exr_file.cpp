#include "src/image/output/exr_file.h"

#include <new>

namespace ninebit::image_detail {

namespace {

constexpr std::size_t kShortName = 31;  // longer names are marked in the file's version

std::int64_t write(exr_const_context_t, void* file, const void* bytes, std::uint64_t size, std::uint64_t position,
                   exr_stream_error_func_ptr_t) {
  auto& output = *static_cast<posix::CheckedFile*>(file);
  if (output.tell() != position && !output.seek(position)) return -1;
  return output.write(bytes, size) ? static_cast<std::int64_t>(size) : -1;
}

void ignore(exr_const_context_t, exr_result_t, const char*) {}

exr_pixel_type_t pixel_type(const ExrChannel& channel) {
  if (std::holds_alternative<ExrFloatRow>(channel.rows)) return EXR_PIXEL_FLOAT;
  return std::holds_alternative<ExrIntegerRow>(channel.rows) ? EXR_PIXEL_UINT : EXR_PIXEL_HALF;
}

}  // namespace

template <class Call>
void ExrFile::call(const Call& function) {
  if (fault_ == EXR_ERR_SUCCESS) fault_ = function();
  if (fault_ == EXR_ERR_OUT_OF_MEMORY) throw std::bad_alloc();
}

ExrFile::ExrFile(posix::CheckedFile& file) : file_(file) {
  exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
  start.error_handler_fn = &ignore;  // the default one prints
  start.user_data = &file_;
  start.write_fn = &write;
  call([&] { return exr_start_write(&context_, file_.path().c_str(), EXR_WRITE_FILE_DIRECTLY, &start); });
}

ExrFile::~ExrFile() {
  if (context_ != nullptr) exr_finish(&context_);
}

void ExrFile::add_part(const std::string& name, int width, int height, std::span<const ExrChannel> channels) {
  int part = 0;
  const exr_attr_box2i_t data = window_of(width, height);
  constexpr exr_attr_v2f_t kCenter{};
  for (const ExrChannel& channel : channels) {
    if (channel.name.size() > kShortName) call([&] { return exr_set_longname_support(context_, 1); });
  }
  call([&] { return exr_add_part(context_, name.empty() ? nullptr : name.c_str(), EXR_STORAGE_SCANLINE, &part); });
  call([&] {
    return exr_initialize_required_attr(context_, part, &window_, &data, 1.0F, &kCenter, 1.0F,
                                        EXR_LINEORDER_INCREASING_Y, EXR_COMPRESSION_ZIP);
  });
  for (const ExrChannel& channel : channels) {
    call([&] {
      return exr_add_channel(context_, part, channel.name.c_str(), pixel_type(channel), EXR_PERCEPTUALLY_LOGARITHMIC, 1,
                             1);
    });
  }
}

void ExrFile::mark_as_cube() {
  call([&] { return exr_attr_set_envmap(context_, 0, "envmap", EXR_ENVMAP_CUBE); });
}

void ExrFile::begin_blocks() {
  call([&] { return exr_write_header(context_); });
}

void ExrFile::add_block(int part, int row, std::span<const std::uint8_t> bytes) {
  call([&] { return exr_write_scanline_chunk(context_, part, row, bytes.data(), bytes.size()); });
}

std::string ExrFile::finish() {
  call([&] { return exr_finish(&context_); });
  return fault_ == EXR_ERR_SUCCESS ? std::string() : exr_get_default_error_message(fault_);
}

}  // namespace ninebit::image_detail
