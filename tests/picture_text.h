// Where the text of a picture stands: of the PostScript that gnuplot's cairo draws with the layout of the PNG, by the metrics of
// DejaVu Sans, and of its SVG. What is cut at the edge or lies on other text is found by it.
#pragma once
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "base/error.h"

namespace whine {

// Advance and ink of the characters of a TrueType font, in parts of its size.
class FontMetrics {
 public:
  struct Glyph {
    double advance = 0.8, left = 0, right = 0.8, low = 0, high = 0.76;
  };

  // Throws Error(io) where there is no such font.
  explicit FontMetrics(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) fail(Failure::io, path, ": no such font; `make deps` installs fonts-dejavu-core");
    bytes_.assign(std::istreambuf_iterator<char>(file), {});
    for (size_t i = 0; i < u16(4); ++i)
      table_[bytes_.substr(12 + 16 * i, 4)] = static_cast<size_t>(i32(12 + 16 * i + 8));
    units_ = static_cast<double>(u16(table_.at("head") + 18));
    long_offsets_ = u16(table_.at("head") + 50) == 1;
    advances_ = u16(table_.at("hhea") + 34);
    const size_t cmap = table_.at("cmap");
    for (size_t i = 0; i < u16(cmap + 2); ++i)
      if (const size_t at = cmap + static_cast<size_t>(i32(cmap + 4 + 8 * i + 4)); u16(at) == 4) map_ = at;
  }

  Glyph of(char32_t character) const {
    const size_t glyph = number(character);
    if (glyph == 0) return {};
    const auto em = [&](double units) { return units / units_; };
    Glyph out;
    out.advance = em(static_cast<double>(u16(table_.at("hmtx") + 4 * std::min(glyph, advances_ - 1))));
    const size_t loca = table_.at("loca");
    const auto offset = [&](size_t i) {
      return long_offsets_ ? static_cast<size_t>(i32(loca + 4 * i)) : 2 * u16(loca + 2 * i);
    };
    if (offset(glyph) == offset(glyph + 1)) {
      out.right = out.high = 0;
      return out;
    }
    const size_t at = table_.at("glyf") + offset(glyph);
    out.left = em(i16(at + 2));
    out.low = em(i16(at + 4));
    out.right = em(i16(at + 6));
    out.high = em(i16(at + 8));
    return out;
  }

 private:
  size_t u16(size_t at) const {
    return static_cast<size_t>(static_cast<unsigned char>(bytes_.at(at))) << 8 |
           static_cast<unsigned char>(bytes_.at(at + 1));
  }
  int i16(size_t at) const { return static_cast<int16_t>(u16(at)); }
  long i32(size_t at) const { return static_cast<long>(u16(at) << 16 | u16(at + 2)); }
  size_t number(char32_t c) const {
    const size_t segments = u16(map_ + 6) / 2;
    for (size_t s = 0; s < segments; ++s) {
      const size_t end = u16(map_ + 14 + 2 * s), start = u16(map_ + 16 + 2 * (segments + s)),
                   range_at = map_ + 16 + 2 * (3 * segments + s), range = u16(range_at);
      if (c > end || c < start) continue;
      const size_t delta = u16(map_ + 16 + 2 * (2 * segments + s));
      if (range == 0) return (c + delta) & 0xffff;
      const size_t glyph = u16(range_at + range + 2 * (c - start));
      return glyph == 0 ? 0 : (glyph + delta) & 0xffff;
    }
    return 0;
  }

  std::string bytes_;
  std::map<std::string, size_t> table_;
  double units_ = 1;
  bool long_offsets_ = true;
  size_t advances_ = 1, map_ = 0;
};

// A piece of text in one font: pixels from the left and from the top.
struct PictureText {
  std::string words;
  double left = 0, right = 0, top = 0, bottom = 0;
  double end_x = 0, end_y = 0, start_x = 0, start_y = 0, size = 0;  // of its base line; of its letters
};

namespace picture {

inline const FontMetrics& font(const std::string& name) {
  static std::map<std::string, FontMetrics> fonts;
  const std::string file = name.find("Bold") != std::string::npos ? "DejaVuSans-Bold" : "DejaVuSans";
  const auto at = fonts.find(file);
  return at != fonts.end()
             ? at->second
             : fonts.emplace(file, "/usr/share/fonts/truetype/dejavu/" + file + ".ttf").first->second;
}

// The characters of a text at a place, along (dx, dy), a unit vector; down: of letters.
inline PictureText placed(const std::u32string& characters, const FontMetrics& metrics, double size, double x,
                          double y, double dx, double dy) {
  PictureText out;
  out.start_x = x;
  out.start_y = y;
  out.size = size;
  out.left = out.top = 1e9;
  out.right = out.bottom = -1e9;
  double along = 0;
  const auto take = [&](double u, double v) {  // along the base line and above it
    const double px = x + dx * u + dy * v, py = y + dy * u - dx * v;
    out.left = std::min(out.left, px);
    out.right = std::max(out.right, px);
    out.top = std::min(out.top, py);
    out.bottom = std::max(out.bottom, py);
  };
  for (const char32_t c : characters) {
    const FontMetrics::Glyph g = metrics.of(c);
    if (g.right > g.left) {
      take(along + size * g.left, size * g.low);
      take(along + size * g.right, size * g.high);
    }
    along += size * g.advance;
    out.words += c < 0x80 ? static_cast<char>(c) : '?';
  }
  out.end_x = x + dx * along;
  out.end_y = y + dy * along;
  return out;
}

// A string of PostScript with its escapes, in Windows' Latin alphabet; what lies beyond it stands in fonts of its own, as numbers.
inline std::u32string characters_of(const std::string& ps) {
  std::u32string out;
  for (size_t i = 0; i < ps.size(); ++i) {
    unsigned c = static_cast<unsigned char>(ps[i]);
    if (c == '\\' && i + 1 < ps.size()) {
      c = static_cast<unsigned char>(ps[++i]);
      if (c == '\n') continue;  // the string goes on in the next line
      if (std::isdigit(static_cast<int>(c))) {
        c = 0;
        for (int n = 0; n < 3; ++n) c = 8 * c + static_cast<unsigned>(ps[i + static_cast<size_t>(n)] - '0');
        i += 2;
      }
    }
    out += c == 0x85 ? U'…' : c == 0x96 ? U'–' : c == 0x97 ? U'—' : static_cast<char32_t>(c);
  }
  return out;
}

}  // namespace picture

// Texts of a picture in PostScript by cairo.
inline std::vector<PictureText> texts_of_postscript(const std::string& bytes) {
  std::vector<PictureText> out;
  std::map<std::string, std::string> fonts;
  std::string resource, font;
  double size = 1, x = 0, y = 0, line_x = 0, line_y = 0, dx = 1, dy = 0;
  const size_t page = bytes.find("%%EndPageSetup");
  if (page == std::string::npos) fail(Failure::numerical, "no page in the PostScript of a picture");
  for (size_t at = 0; (at = bytes.find("%%BeginResource: font ", at)) < page; ++at) {
    resource = bytes.substr(at + 22, bytes.find('\n', at) - at - 22);
    const size_t name = bytes.find("\n/f-", at);
    fonts[bytes.substr(name + 1, bytes.find(' ', name) - name - 1)] = resource;
  }
  const auto show = [&](const std::u32string& characters) {
    PictureText text = picture::placed(characters, picture::font(fonts[font]), size, x, y, dx, dy);
    x = text.end_x;
    y = text.end_y;
    if (text.right > text.left) out.push_back(text);
  };
  std::vector<std::string> words;
  for (size_t i = page; i < bytes.size();) {
    const char c = bytes[i];
    if (c == '(' || c == '<') {
      size_t end = i + 1;
      if (bytes.compare(i, 2, "<<") == 0) {  // of a picture in it
        i += 2;
        continue;
      }
      if (c == '<') {
        end = bytes.find('>', i);
        // Two letters a character.
        show(std::u32string((end - i - 1) / 2, U'●'));
      } else {
        for (int depth = 1;; ++end) {
          if (bytes[end] == '\\') {
            ++end;
          } else if (bytes[end] == '(') {
            ++depth;
          } else if (bytes[end] == ')' && --depth == 0) {
            break;
          }
        }
        show(picture::characters_of(bytes.substr(i + 1, end - i - 1)));
      }
      i = end + 1;
    } else if (std::isspace(static_cast<unsigned char>(c)) || c == '[' || c == ']') {
      ++i;
    } else {
      size_t end = i;
      const auto ends = [](char d) {
        return std::isspace(static_cast<unsigned char>(d)) ||
               std::string_view("[]()<>").find(d) != std::string_view::npos;
      };
      while (end < bytes.size() && !ends(bytes[end])) ++end;
      end += end == i ? 1 : 0;
      const std::string word = bytes.substr(i, end - i);
      if (word == "cairo_image" || word == "cairo_imagemask") {
        i = bytes.find("~>", end);
        if (i == std::string::npos) break;
        i += 2;
        continue;
      }
      if (word == "Tm" && words.size() >= 6) {
        const auto number = [&](size_t k) { return std::stod(words[words.size() - 6 + k]); };
        size = std::hypot(number(0), number(1));
        dx = number(0) / size;
        dy = number(1) / size;
        x = line_x = number(4);
        y = line_y = number(5);
      } else if (word == "Td" && words.size() >= 2) {
        const double along = size * std::stod(words[words.size() - 2]),
                     up = size * std::stod(words[words.size() - 1]);
        x = line_x += dx * along + dy * up;
        y = line_y += dy * along - dx * up;
      } else if (word == "Tf" && words.size() >= 2) {
        font = words[words.size() - 2].substr(1);
      }
      words.push_back(word);
      if (words.size() > 8) words.erase(words.begin());
      i = end;
    }
  }
  return out;
}

// Texts of a picture in SVG by gnuplot.
inline std::vector<PictureText> texts_of_svg(const std::string& bytes) {
  std::vector<PictureText> out;
  const auto attribute = [](const std::string& tag, const std::string& name) -> std::string {
    const size_t at = tag.find(" " + name + "=\"");
    if (at == std::string::npos) return "";
    const size_t from = at + name.size() + 3;
    return tag.substr(from, tag.find('"', from) - from);
  };
  for (size_t at = 0; (at = bytes.find("<text>", at)) != std::string::npos;) {
    const size_t group = bytes.rfind("<g transform=\"translate(", at), end = bytes.find("</text>", at);
    const std::string frame = bytes.substr(group, bytes.find('>', group) - group),
                      inside = bytes.substr(at + 6, end - at - 6);
    at = end;
    const size_t open = frame.find('('), turn = frame.find("rotate(");
    const double x = std::stod(frame.substr(open + 1)),
                 y = std::stod(frame.substr(frame.find(',', open) + 1)),
                 angle = turn == std::string::npos
                             ? 0
                             : std::stod(frame.substr(turn + 7)) * std::numbers::pi / 180,
                 dx = std::cos(angle), dy = std::sin(angle);
    struct Part {
      std::u32string characters;
      double size, rise;  // below the line
      std::string font;
    };
    std::vector<Part> parts{{U"", std::stod(attribute(frame, "font-size")), 0, "DejaVuSans"}};
    const double usual = parts[0].size;
    for (size_t i = 0; i < inside.size();) {
      if (inside[i] == '<') {
        const size_t close = inside.find('>', i);
        const std::string tag = inside.substr(i, close - i);
        if (tag.starts_with("<tspan")) {
          const std::string size = attribute(tag, "font-size"), drop = attribute(tag, "dy");
          parts.push_back({U"", size.empty() ? usual : std::stod(size),
                           parts.back().rise + (drop.empty() ? 0 : std::stod(drop)),
                           attribute(tag, "font-weight") == "bold" ? "DejaVuSans-Bold" : "DejaVuSans"});
        }
        i = close + 1;
        continue;
      }
      char32_t c = static_cast<unsigned char>(inside[i]);
      size_t bytes_of = c < 0x80 ? 1 : c < 0xe0 ? 2 : c < 0xf0 ? 3 : 4;
      if (c == '&') {
        bytes_of = inside.find(';', i) - i + 1;
        c = inside[i + 1] == 'l' ? '<' : inside[i + 1] == 'g' ? '>' : '&';
      } else if (bytes_of > 1) {
        c &= 0xffU >> (bytes_of + 1);
        for (size_t k = 1; k < bytes_of; ++k) c = c << 6 | (static_cast<unsigned char>(inside[i + k]) & 0x3f);
      }
      parts.back().characters += c;
      i += bytes_of;
    }
    double width = 0;
    for (const Part& part : parts)
      for (const char32_t c : part.characters) width += part.size * picture::font(part.font).of(c).advance;
    const std::string anchor = attribute(frame, "text-anchor");
    double along = anchor == "middle" ? -0.5 * width : anchor == "end" ? -width : 0;
    for (const Part& part : parts) {
      const PictureText text =
          picture::placed(part.characters, picture::font(part.font), part.size,
                          x + dx * along - dy * part.rise, y + dy * along + dx * part.rise, dx, dy);
      along += std::hypot(text.end_x - text.start_x, text.end_y - text.start_y);
      if (text.right > text.left) out.push_back(text);
    }
  }
  return out;
}

// What is wrong with them: a line for each text that comes nearer to an edge than `margin` pixels and for each two that lie on each other.
inline std::vector<std::string> faults_of(const std::vector<PictureText>& texts, double width,
                                          double height) {
  constexpr double kMargin = 3, kTouch = 1;  // pixels
  // Letters of a PNG stand at whole pixels: its lines may be longer by this part of their length.
  constexpr double kLonger = 0.006;
  std::vector<std::string> out;
  for (const PictureText& t : texts)
    if (t.left < kMargin || t.right + kLonger * (t.right - t.left) > width - kMargin || t.top < kMargin ||
        t.bottom > height - kMargin)
      out.push_back(text("cut: '", t.words, "', ", std::round(t.left), " to ", std::round(t.right), ", ",
                         std::round(t.top), " to ", std::round(t.bottom), " of ", width, " x ", height));
  for (size_t i = 0; i < texts.size(); ++i)
    for (size_t j = i + 1; j < texts.size(); ++j) {
      const PictureText &a = texts[i], &b = texts[j];
      const double across = std::min(a.right, b.right) - std::max(a.left, b.left),
                   down = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
      if (across < kTouch || down < kTouch) continue;
      // What follows in one line, such as an index.
      if (std::hypot(b.start_x - a.end_x, b.start_y - a.end_y) < 0.6 * std::max(a.size, b.size)) continue;
      // A letter that is drawn twice at one place.
      if (a.words == b.words && std::hypot(a.start_x - b.start_x, a.start_y - b.start_y) < 0.5) continue;
      out.push_back(text("overlap: '", a.words, "' and '", b.words, "' at ",
                         std::round(std::max(a.left, b.left)), ", ", std::round(std::max(a.top, b.top))));
    }
  return out;
}

}  // namespace whine
