// SPDX-License-Identifier: Apache-2.0
#include "raster/picture.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/error.h"

namespace skysweep::raster {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;

double font_scale(double height_px) { return height_px / 21; }  // its capitals are 21 pixels high at scale 1

static_assert(sizeof(Rgb8) == 3);

}  // namespace

void draw_text(Array2d<Rgb8>& image, int x, int y, const std::string& text, double height_px, Rgb8 color) {
  cv::Mat view(image.height(), image.width(), CV_8UC3, image.data());  // channels in our order, and so is the colour
  cv::putText(view, text, {x, y}, kFont, font_scale(height_px), {1. * color.r, 1. * color.g, 1. * color.b}, 1,
              cv::LINE_AA);
}

int text_width_px(const std::string& text, double height_px) {
  int baseline = 0;
  return cv::getTextSize(text, kFont, font_scale(height_px), 1, &baseline).width;
}

std::string picture_bytes(const Array2d<Rgba8>& image, PictureFormat format, int quality) {
  SKY_CHECK(!image.empty());
  const bool jpeg = format == PictureFormat::jpeg;
  cv::Mat pixels(image.height(), image.width(), jpeg ? CV_8UC3 : CV_8UC4);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Rgba8 c = image(x, y);
      if (jpeg)
        pixels.at<cv::Vec3b>(y, x) = {c.b, c.g, c.r};
      else
        pixels.at<cv::Vec4b>(y, x) = {c.b, c.g, c.r, c.a};
    }
  std::vector<int> parameters;
  if (jpeg) parameters = {cv::IMWRITE_JPEG_QUALITY, quality};
  // Above 100 OpenCV asks libwebp for lossless compression.
  if (format == PictureFormat::webp) parameters = {cv::IMWRITE_WEBP_QUALITY, quality == 100 ? 101 : quality};
  const char* extension = jpeg ? ".jpg" : format == PictureFormat::webp ? ".webp" : ".png";
  std::vector<unsigned char> bytes;
  if (!cv::imencode(extension, pixels, bytes, parameters))
    throw failure(std::string("OpenCV cannot encode ") + extension + " images here");
  return {bytes.begin(), bytes.end()};
}

std::string png_bytes(const Array2d<Rgb8>& image) {
  SKY_CHECK(!image.empty());
  cv::Mat bgr(image.height(), image.width(), CV_8UC3);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Rgb8 rgb = image(x, y);
      bgr.at<cv::Vec3b>(y, x) = {rgb.b, rgb.g, rgb.r};
    }
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".png", bgr, bytes)) throw failure("OpenCV cannot encode PNG images here");
  return {bytes.begin(), bytes.end()};
}

}  // namespace skysweep::raster
