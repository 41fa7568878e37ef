#include "adapters/images/image_files.hpp"

#include <jpeglib.h>
#include <png.h>

#include <csetjmp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <opencv2/imgproc.hpp>

namespace window_ingress::adapters {
namespace {

constexpr int kFileQuality = 95;

// On an error, libjpeg must leave its call by longjmp; messages are suppressed.
struct JpegErrors {
  jpeg_error_mgr manager;
  std::jmp_buf failed;
};

void useQuietly(jpeg_error_mgr*& place, JpegErrors& errors) {
  place = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = [](j_common_ptr jpeg) {
    std::longjmp(reinterpret_cast<JpegErrors*>(jpeg->err)->failed, 1);
  };
  errors.manager.emit_message = [](j_common_ptr, int) {};
}

// Nothing with a destructor may live between setjmp and a longjmp back to it.
bool readJpegInto(cv::Mat& image, jpeg_decompress_struct& jpeg, JpegErrors& errors,
                  const std::vector<std::uint8_t>& bytes) {
  if (setjmp(errors.failed) != 0) return false;
  jpeg_mem_src(&jpeg, bytes.data(), bytes.size());
  jpeg_read_header(&jpeg, TRUE);
  const bool grey = jpeg.jpeg_color_space == JCS_GRAYSCALE;
  jpeg.out_color_space = grey ? JCS_GRAYSCALE : JCS_EXT_BGR;
  jpeg_start_decompress(&jpeg);
  image.create(static_cast<int>(jpeg.output_height), static_cast<int>(jpeg.output_width),
               grey ? CV_8UC1 : CV_8UC3);
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW row = image.ptr(static_cast<int>(jpeg.output_scanline));
    jpeg_read_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_decompress(&jpeg);
  return true;
}

bool writeJpegInto(unsigned char*& bytes, unsigned long& size, jpeg_compress_struct& jpeg, JpegErrors& errors,
                   const cv::Mat& image, int quality) {
  if (setjmp(errors.failed) != 0) return false;
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = static_cast<JDIMENSION>(image.cols);
  jpeg.image_height = static_cast<JDIMENSION>(image.rows);
  jpeg.input_components = image.channels();
  jpeg.in_color_space = image.channels() == 1 ? JCS_GRAYSCALE : JCS_EXT_BGR;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, quality, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  while (jpeg.next_scanline < jpeg.image_height) {
    JSAMPROW row = const_cast<JSAMPROW>(image.ptr(static_cast<int>(jpeg.next_scanline)));
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  return true;
}

cv::Mat readJpeg(const std::vector<std::uint8_t>& bytes) {
  JpegErrors errors;
  jpeg_decompress_struct jpeg{};
  useQuietly(jpeg.err, errors);
  jpeg_create_decompress(&jpeg);
  const std::unique_ptr<jpeg_decompress_struct, decltype(&jpeg_destroy_decompress)> owned(
      &jpeg, &jpeg_destroy_decompress);
  cv::Mat image;
  return readJpegInto(image, jpeg, errors, bytes) ? image : cv::Mat();
}

cv::Mat readPng(const std::vector<std::uint8_t>& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, decltype(&png_image_free)> owned(&png, &png_image_free);
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size())) return {};
  const bool grey = (png.format & PNG_FORMAT_FLAG_COLOR) == 0;
  const bool transparent = (png.format & PNG_FORMAT_FLAG_ALPHA) != 0;
  png.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // sRGB, as 8-bit images are
  png.format = transparent ? PNG_FORMAT_BGRA : grey ? PNG_FORMAT_GRAY : PNG_FORMAT_BGR;
  cv::Mat image(static_cast<int>(png.height), static_cast<int>(png.width),
                CV_8UC(PNG_IMAGE_SAMPLE_CHANNELS(png.format)));
  if (!png_image_finish_read(&png, nullptr, image.data, static_cast<png_int_32>(image.step), nullptr))
    return {};
  if (!transparent) return image;
  cv::Mat opaque;
  cv::cvtColor(image, opaque, grey ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGRA2BGR);
  return opaque;
}

bool writePng(const std::string& file, const cv::Mat& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.cols);
  png.height = static_cast<png_uint_32>(image.rows);
  png.format = image.channels() == 1 ? PNG_FORMAT_GRAY : PNG_FORMAT_BGR;
  return png_image_write_to_file(&png, file.c_str(), 0, image.data, static_cast<png_int_32>(image.step),
                                 nullptr) != 0;
}

}  // namespace

cv::Mat readImage(const std::vector<std::uint8_t>& bytes) {
  return bytes.size() > 1 && bytes[0] == 0xff && bytes[1] == 0xd8 ? readJpeg(bytes) : readPng(bytes);
}

std::vector<std::uint8_t> writeJpeg(const cv::Mat& image, int quality) {
  JpegErrors errors;
  jpeg_compress_struct jpeg{};
  useQuietly(jpeg.err, errors);
  jpeg_create_compress(&jpeg);
  const std::unique_ptr<jpeg_compress_struct, decltype(&jpeg_destroy_compress)> owned(&jpeg,
                                                                                      &jpeg_destroy_compress);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  if (!writeJpegInto(bytes, size, jpeg, errors, image, quality))
    return {};  // on failure libjpeg owns the buffer
  const std::unique_ptr<unsigned char, decltype(&std::free)> buffer(bytes, &std::free);
  return {bytes, bytes + size};
}

bool writeImage(const std::string& file, const cv::Mat& image) {
  const std::string format = std::filesystem::path(file).extension();
  if (format == ".png") return writePng(file, image);
  if (format != ".jpg" && format != ".jpeg") return false;
  const std::vector<std::uint8_t> bytes = writeJpeg(image, kFileQuality);
  std::ofstream output(file, std::ios::binary);
  output.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  output.close();
  return output && !bytes.empty();
}

}  // namespace window_ingress::adapters
