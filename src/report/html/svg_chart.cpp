// SPDX-License-Identifier: Apache-2.0
#include "report/html/svg_chart.h"

#include <algorithm>
#include <cmath>

#include "report/text/figures.h"

namespace skysweep::report {
namespace {

constexpr double kWidth = 560, kHeight = 320;
constexpr double kLeft = 68, kRight = 16, kTop = 34, kBottom = 50;

// Where values lie on the paper.
class Plot {
 public:
  explicit Plot(const Chart& chart) : chart_(chart) {}
  double x(double value) const { return kLeft + share(chart_.x, value) * (kWidth - kLeft - kRight); }
  double y(double value) const { return kHeight - kBottom - share(chart_.y, value) * (kHeight - kTop - kBottom); }

 private:
  static double share(const Axis& axis, double value) {
    const auto scaled = [&](double v) { return axis.logarithmic ? std::log10(std::max(v, 1e-12)) : v; };
    const double position = (scaled(value) - scaled(axis.low)) / (scaled(axis.high) - scaled(axis.low));
    return std::clamp(position, 0.0, 1.0);  // what leaves the axes lies on their border
  }
  const Chart& chart_;
};

// Round numbers inside an axis: powers of ten, or steps of 1, 2 or 5 times one.
std::vector<double> ticks(const Axis& axis) {
  std::vector<double> out;
  if (axis.logarithmic) {
    const double decades = std::log10(axis.high / axis.low);
    for (double power = std::pow(10, std::floor(std::log10(axis.low))); power <= axis.high * 1.0001; power *= 10)
      for (const double digit : {1., 2., 5.})
        if (const double tick = digit * power;
            (digit == 1 || decades < 2.5) && tick >= axis.low * 0.9999 && tick <= axis.high * 1.0001)
          out.push_back(tick);
    return out;
  }
  const double rough = (axis.high - axis.low) / 6;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double digit : {5., 2., 1.})
    if (digit * power >= rough) step = digit * power;
  for (double i = std::ceil(axis.low / step - 1e-9); i * step <= axis.high + 1e-9 * step; ++i) out.push_back(i * step);
  return out;
}

std::string tick_text(const Axis& axis, double value) {
  // Plus 0 turns the negative zero that rounding may leave into a plain one.
  return axis.percent ? format("%g %%", std::round(value * 1e6) / 1e4 + 0.0)
                      : format("%g", std::round(value * 1e9) / 1e9 + 0.0);
}

std::string text_at(double x, double y, const std::string& attributes, const std::string& text) {
  return format("<text x=\"%.1f\" y=\"%.1f\" ", x, y) + attributes + ">" + escaped(text) + "</text>\n";
}

std::string axes(const Chart& chart, const Plot& plot) {
  const double bottom = kHeight - kBottom, right = kWidth - kRight;
  std::string out;
  for (const double tick : ticks(chart.x)) {
    const double x = plot.x(tick);
    out += format("<line class=\"grid\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>\n", x, kTop, x, bottom);
    out += text_at(x, bottom + 16, "text-anchor=\"middle\"", tick_text(chart.x, tick));
  }
  for (const double tick : ticks(chart.y)) {
    const double y = plot.y(tick);
    out += format("<line class=\"grid\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>\n", kLeft, y, right, y);
    out += text_at(kLeft - 6, y + 4, "text-anchor=\"end\"", tick_text(chart.y, tick));
  }
  out += text_at((kLeft + right) / 2, kHeight - 14, "text-anchor=\"middle\"", chart.x.label);
  const double middle = (kTop + bottom) / 2;
  out += text_at(14, middle, format("text-anchor=\"middle\" transform=\"rotate(-90 14 %.1f)\"", middle), chart.y.label);
  return out;
}

std::string bars(const Chart& chart, const Plot& plot) {
  std::string out;
  for (const Bar& bar : chart.bars) {
    const double left = plot.x(bar.from), top = plot.y(bar.height);
    out += format("<rect x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" fill=\"%s\"/>\n", left, top,
                  std::max(0.0, plot.x(bar.to) - left - 0.5), kHeight - kBottom - top, bar.color.c_str());
  }
  return out;
}

std::string line_style(const Line& line) {
  return "fill=\"none\" stroke=\"" + line.color + "\" stroke-width=\"2\"" +
         (line.dashed ? " stroke-dasharray=\"5 4\"" : "");
}

std::string lines(const Chart& chart, const Plot& plot) {
  std::string out;
  for (const Line& line : chart.lines) {
    std::string path;
    bool pen_down = false;
    for (const Vec2d p : line.points) {
      const bool known = std::isfinite(p.x) && std::isfinite(p.y);
      if (known) path += format("%s%.2f %.2f ", pen_down ? "L" : "M", plot.x(p.x), plot.y(p.y));
      if (known && line.dots)
        out += format("<circle cx=\"%.2f\" cy=\"%.2f\" r=\"3.5\" fill=\"%s\"/>\n", plot.x(p.x), plot.y(p.y),
                      line.color.c_str());
      pen_down = known;
    }
    if (!path.empty()) out += "<path d=\"" + path + "\" " + line_style(line) + "/>\n";
  }
  return out;
}

std::string legend(const Chart& chart) {
  std::string out;
  double y = kTop + 14;
  for (const Line& line : chart.lines) {
    if (line.name.empty()) continue;
    out += format("<path d=\"M%.1f %.1f h22\" ", kLeft + 10, y - 4) + line_style(line) + "/>\n";
    out += text_at(kLeft + 38, y, "class=\"legend\"", line.name);
    y += 17;
  }
  return out;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      out += c;
  }
  return out;
}

std::string to_svg(const Chart& chart) {
  const Plot plot(chart);
  std::string out =
      format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" role=\"img\">\n", kWidth, kHeight);
  out += "<title>" + escaped(chart.title) + "</title>\n";
  out += text_at(kLeft, 20, "class=\"title\"", chart.title);
  out += axes(chart, plot) + bars(chart, plot) + lines(chart, plot) + legend(chart);
  out += format("<rect class=\"frame\" x=\"%g\" y=\"%g\" width=\"%g\" height=\"%g\"/>\n", kLeft, kTop,
                kWidth - kLeft - kRight, kHeight - kTop - kBottom);
  return out + "</svg>\n";
}

}  // namespace skysweep::report
