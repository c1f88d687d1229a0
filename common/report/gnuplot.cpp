#include "report/gnuplot.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/error.h"
#include "base/visible.h"
#include "report/draw_panels.h"
#include "report/figure_words.h"
#include "report/text_width.h"

namespace whine {
namespace {

// gnuplot runs a command for a file name that begins with '<', and takes a template that begins with '-' for an option.
std::string plain_path(const std::string& path) {
  return path.starts_with('/') ? path : "./" + path;
}

// Words over a picture: letters as large as let them end inside of it. scale: of its letters, 24 pixels each.
std::string fitting(const std::string& words, double scale) {
  constexpr double kWidth = 1570, kSize = 24, kLeast = 0.5;
  const double fits = kWidth / (kSize * std::max(1.0, text_width(words)));
  if (fits >= scale) return scale == 1 ? words : text("{/*", scale, " ", words, "}");
  if (fits > kLeast) return text("{/*", fixed(fits, 3), " ", words, "}");
  return text("{/*", kLeast, " ", broken_lines(words, kWidth / kSize / kLeast - 1)[0], " …}");
}

// Lines under a picture that are too long go on in the next.
std::string rows_of(const std::string& name, const std::string& words) {
  const std::vector<std::string> rows = broken_lines(words, kNoteWidth);
  if (rows.size() < 2) return "";
  std::string script = text("rows_", name, " = ", rows.size(), "; ");
  for (size_t r = 0; r < rows.size(); ++r)
    script += text("row", r + 1, "_", name, " = ", gnuplot_string(rows[r]), "; ");
  return script;
}

std::string prelude(const Figure& figure, const std::string& tsv_path, const std::string& template_path,
                    Picture picture) {
  std::string script = "set encoding utf8; ";
  const PanelPicture panels = figure.panels.empty() ? PanelPicture{figure.height, ""} : panel_picture(figure);
  const int height = panels.height;
  const std::vector<std::string>& captions = figure.captions.empty() ? figure.notes : figure.captions;
  // A point of pngcairo is 4/3 of its pixels, one of svg is one pixel: the scale makes both pictures alike.
  if (picture == Picture::gif) {
    script += text("set terminal gif animate delay 8 loop 0 linewidth 0.8 size 800,", height / 2,
                   " font 'DejaVu Sans,9'");
  } else {
    script += picture == Picture::png ? "set terminal pngcairo" : "set terminal svg fontscale 1.333";
    script += text(" size 1600,", height, " font 'DejaVu Sans,18'");
  }
  script += " enhanced background '#ffffff'; ";
  const auto plots = std::filesystem::path(plain_path(template_path)).parent_path();
  script += text("plots = ", gnuplot_string(plots), "; height = real(", height,
                 "); notes = ", captions.size(), "; ");
  script += text("tsv = ", gnuplot_string(plain_path(tsv_path)),
                 "; title = ", gnuplot_string(fitting(figure.title, 1)), "; ");
  std::string heading = fitting(without_markup(figure.title), 1), scenes;
  for (const std::string& scene : figure.scenes)
    scenes += (scenes.empty() ? "" : "; ") + without_markup(scene);
  if (!scenes.empty()) heading += "\n" + fitting(scenes, 0.68);
  script += text("heading = ", gnuplot_string(heading), "; ");
  for (size_t i = 0; i < captions.size(); ++i)
    script += text("note", i + 1, " = ", gnuplot_string(captions[i]), "; ") +
              rows_of(text("note", i + 1), captions[i]);
  for (const auto& [name, value] : figure.numbers) {
    char number[40];
    std::snprintf(number, sizeof number, "%.17g", value);
    // gnuplot divides integers as integers: a number is always a real one here
    script += name + " = real(" + number + "); ";
  }
  for (const auto& [name, value] : figure.words) {
    script += name + " = " + gnuplot_string(value) + "; ";
    if (name.starts_with("line")) script += rows_of(name, value);
  }
  return script + panels.script;
}

struct Pipe {
  int end[2] = {-1, -1};
  Pipe() {
    if (pipe2(end, O_CLOEXEC) != 0) fail(Failure::io, "gnuplot: no pipe: ", std::strerror(errno));
  }
  ~Pipe() {
    for (int& e : end) close_end(e);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  static void close_end(int& e) {
    if (e >= 0) close(e);
    e = -1;
  }
};

// Environment of this process without what changes gnuplot's output.
std::vector<std::string> plain_environment() {
  std::vector<std::string> kept{"LC_ALL=C.UTF-8"};
  for (char** e = environ; *e; ++e) {
    const std::string entry = *e;
    bool drops = false;
    for (const char* start : {"LC_", "LANG", "GNU", "GDFONTPATH", "FIT_"})
      drops |= entry.rfind(start, 0) == 0;
    if (!drops) kept.push_back(entry);
  }
  return kept;
}

std::string first_line_that_matters(const std::string& complaints) {
  size_t begin = 0;
  std::string fallback;
  while (begin < complaints.size()) {
    size_t end = complaints.find('\n', begin);
    if (end == std::string::npos) end = complaints.size();
    const std::string line = complaints.substr(begin, end - begin);
    const bool warning = line.find("arning") != std::string::npos;
    if (!warning && (line.find("line ") != std::string::npos || line.find("rror") != std::string::npos))
      return line;
    if (line.find_first_not_of(" \t^") != std::string::npos && fallback.empty()) fallback = line;
    begin = end + 1;
  }
  return fallback.empty() ? "no message" : fallback;
}

}  // namespace

std::string gnuplot_string(const std::string& words) {
  std::string out = "'";
  for (const char c : visible(words)) {
    if (c == '\n') {
      out += "'.\"\\n\".'";
    } else if (c == '\'') {
      out += "'.\"'\".'";
    } else {
      out += c == '\t' || c == '\r' ? ' ' : c;
    }
  }
  return out + "'";
}

std::string template_of(const Figure& figure, const std::string& folder, const std::string& name) {
  return folder + "/" + (figure.panels.empty() ? name : "panels") + ".gp";
}

std::string draw(const Figure& figure, const std::string& tsv_path, const std::string& template_path,
                 Picture picture) {
  if (access(template_path.c_str(), R_OK) != 0)
    fail(Failure::io, template_path, ": ", std::strerror(errno),
         "; the template of the figure is needed, see --plots");
  std::vector<std::string> words{"gnuplot", "-d", "-e", prelude(figure, tsv_path, template_path, picture),
                                 plain_path(template_path)};
  std::vector<std::string> environment = plain_environment();
  const auto pointers = [](std::vector<std::string>& strings) {
    std::vector<char*> p;
    p.reserve(strings.size() + 1);
    for (auto& s : strings) p.push_back(s.data());
    p.push_back(nullptr);
    return p;
  };

  Pipe out, err;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.end[1], 1);
  posix_spawn_file_actions_adddup2(&actions, err.end[1], 2);
  pid_t pid = 0;
  const int started =
      posix_spawnp(&pid, "gnuplot", &actions, nullptr, pointers(words).data(), pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  if (started != 0)
    fail(Failure::io, "gnuplot does not start: ", std::strerror(started),
         "; figures need it: install it with `make deps` (package gnuplot-nox)");
  Pipe::close_end(out.end[1]);
  Pipe::close_end(err.end[1]);

  std::array<std::string, 2> text_of;
  std::array<pollfd, 2> waiting{pollfd{out.end[0], POLLIN, 0}, pollfd{err.end[0], POLLIN, 0}};
  char buffer[1 << 16];
  for (int open = 2; open > 0;) {
    if (poll(waiting.data(), waiting.size(), -1) < 0) {
      if (errno == EINTR) continue;
      break;
    }
    for (size_t i = 0; i < 2; ++i) {
      if (waiting[i].fd < 0 || waiting[i].revents == 0) continue;
      const ssize_t n = ::read(waiting[i].fd, buffer, sizeof buffer);
      if (n > 0) {
        text_of[i].append(buffer, static_cast<size_t>(n));
      } else if (n == 0 || errno != EINTR) {
        waiting[i].fd = -1;
        --open;
      }
    }
  }
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  const auto& [picture_bytes, complaints] = text_of;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    fail(Failure::numerical, "gnuplot failed on ", template_path, ": ", first_line_that_matters(complaints));
  const bool whole = picture == Picture::svg   ? picture_bytes.find("</svg>") != std::string::npos
                     : picture == Picture::png ? picture_bytes.rfind("\x89PNG", 0) == 0
                                               : picture_bytes.rfind("GIF89a", 0) == 0;
  if (!whole)
    fail(Failure::numerical, "gnuplot drew no picture with ", template_path, ": ",
         first_line_that_matters(complaints));
  return picture_bytes;
}

}  // namespace whine
