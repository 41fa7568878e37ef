#include "adapters/images/image_files.hpp"

#include <jpeglib.h>
#include <png.h>

#include <csetjmp>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <opencv2/imgproc.hpp>

namespace window_ingress::adapters {
namespace {

constexpr int kFileQuality = 95;
constexpr int kExifMarker = JPEG_APP0 + 1;

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

/// How the camera was held, 1 to 8 (EXIF 2.3, tag 0x0112); 1, upright, if the file does not say.
unsigned orientationOf(const jpeg_decompress_struct& jpeg) {
  for (const auto* marker = jpeg.marker_list; marker; marker = marker->next) {
    if (marker->data_length < 14 || std::memcmp(marker->data, "Exif\0\0", 6) != 0) continue;
    const std::uint8_t* const tiff = marker->data + 6;
    const auto number = [&](std::size_t at, unsigned bytes) {
      unsigned sum = 0;
      for (unsigned i = 0; i < bytes && at + bytes <= marker->data_length - 6; ++i)
        sum = sum << 8 | tiff[tiff[0] == 'I' ? at + bytes - 1 - i : at + i];
      return sum;
    };
    const std::size_t entries = number(4, 4);
    for (std::size_t i = 0, at = entries + 2; i < number(entries, 2); ++i, at += 12)
      if (number(at, 2) == 0x0112) return number(at + 8, 2);
  }
  return 1;
}

// Nothing with a destructor may live between setjmp and a longjmp back to it.
bool readJpegInto(cv::Mat& image, unsigned& orientation, jpeg_decompress_struct& jpeg, JpegErrors& errors,
                  const std::vector<std::uint8_t>& bytes) {
  if (setjmp(errors.failed) != 0) return false;
  jpeg_mem_src(&jpeg, bytes.data(), bytes.size());
  jpeg_save_markers(&jpeg, kExifMarker, 0xffff);
  jpeg_read_header(&jpeg, TRUE);
  orientation = orientationOf(jpeg);
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

cv::Mat turnedUpright(const cv::Mat& stored, unsigned orientation) {
  cv::Mat image = stored;
  if (orientation >= 5 && orientation <= 8) cv::transpose(stored, image);
  const bool mirrored = orientation == 2 || orientation == 6,
             upside_down = orientation == 4 || orientation == 8;
  if (mirrored || upside_down) cv::flip(image, image, mirrored ? 1 : 0);
  if (orientation == 3 || orientation == 7) cv::flip(image, image, -1);
  return image;
}

cv::Mat readJpeg(const std::vector<std::uint8_t>& bytes, bool upright) {
  JpegErrors errors;
  jpeg_decompress_struct jpeg{};
  useQuietly(jpeg.err, errors);
  jpeg_create_decompress(&jpeg);
  const std::unique_ptr<jpeg_decompress_struct, decltype(&jpeg_destroy_decompress)> owned(
      &jpeg, &jpeg_destroy_decompress);
  cv::Mat image;
  unsigned orientation = 1;
  if (!readJpegInto(image, orientation, jpeg, errors, bytes)) return {};
  return upright ? turnedUpright(image, orientation) : image;
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

cv::Mat readImage(const std::vector<std::uint8_t>& bytes, bool upright) {
  const bool jpeg = bytes.size() > 1 && bytes[0] == 0xff && bytes[1] == 0xd8;
  return jpeg ? readJpeg(bytes, upright) : readPng(bytes);
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
