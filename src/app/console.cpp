// SPDX-License-Identifier: Apache-2.0
#include "app/console.h"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/option_values.h"
#include "app/printable.h"
#include "core/error.h"

namespace skysweep::app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::string duration_text(double seconds) {
  const int s = static_cast<int>(seconds + 0.5);
  if (s < 60) return std::to_string(s) + " s";
  if (s < 3600) return std::to_string(s / 60) + " min " + std::to_string(s % 60) + " s";
  return std::to_string(s / 3600) + " h " + std::to_string(s % 3600 / 60) + " min";
}

struct Stage {
  std::string name;
  int total = 0;
  int done = 0;
  Clock::time_point start = Clock::now();
  double last_shown = -1;
};

}  // namespace

struct Console::Impl {
  explicit Impl(bool as_json) : json(as_json), terminal(!as_json && isatty(STDOUT_FILENO) == 1) {}

  const bool json, terminal;
  std::mutex mutex;
  Stage stage;
  bool line_open = false;  // a progress line stands on the terminal
  std::shared_ptr<spdlog::logger> file;
  std::vector<std::pair<spdlog::level::level_enum, std::string>> before_file;

  void close_line() {
    if (line_open) std::fputs("\r\033[K", stdout);
    line_open = false;
  }

  void log(spdlog::level::level_enum level, const std::string& text) {
    if (file)
      file->log(level, "{}", printable(text));
    else
      before_file.emplace_back(level, text);
  }

  void event(nlohmann::json object) {
    std::puts(object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
    std::fflush(stdout);
  }

  void print(const char* kind, const std::string& text, bool show) {
    if (json) return event({{"event", kind}, {"text", text}});
    if (!show) return;
    close_line();
    std::fprintf(std::string(kind) == "warning" ? stderr : stdout, "%s\n", printable(text).c_str());
    std::fflush(stdout);
  }

  std::string progress_text() const {
    const double elapsed = seconds_since(stage.start);
    std::string text = stage.name + " " + std::to_string(stage.done) + "/" + std::to_string(stage.total);
    if (stage.done > 0 && elapsed > 0) {
      char rate[32];
      std::snprintf(rate, sizeof rate, ", %.2f/s", stage.done / elapsed);
      text += rate;
      text += ", " + duration_text(elapsed / stage.done * (stage.total - stage.done)) + " left";
    }
    return text + ", " + memory_text(resident_memory());
  }

  void show_progress() {
    const double elapsed = seconds_since(stage.start);
    const bool finished = stage.done == stage.total;
    const double interval = terminal ? 0.2 : 10;
    if (!finished && stage.last_shown >= 0 && elapsed - stage.last_shown < interval) return;
    stage.last_shown = elapsed;
    if (json) {
      const double left = stage.done > 0 ? elapsed / stage.done * (stage.total - stage.done) : 0;
      event({{"event", "progress"},
             {"stage", stage.name},
             {"done", stage.done},
             {"total", stage.total},
             {"seconds", elapsed},
             {"seconds_left", left},
             {"memory_bytes", resident_memory()}});
    } else if (terminal) {
      std::printf("\r\033[K%s", progress_text().c_str());
      line_open = true;
      if (finished) {
        std::puts("");
        line_open = false;
      }
      std::fflush(stdout);
    } else {
      std::puts(progress_text().c_str());
      std::fflush(stdout);
    }
  }
};

Console::Console(bool json) : impl_(std::make_unique<Impl>(json)) {}
Console::~Console() { impl_->close_line(); }

void Console::log_to(const std::filesystem::path& file) {
  const std::lock_guard lock(impl_->mutex);
  try {
    impl_->file =
        std::make_shared<spdlog::logger>("run", std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string()));
  } catch (const spdlog::spdlog_ex& error) {
    throw failure("The log " + file.string() + " cannot be written: " + error.what() + ".");
  }
  impl_->file->set_pattern("%Y-%m-%d %H:%M:%S %l %v");
  impl_->file->flush_on(spdlog::level::info);
  for (const auto& [level, text] : impl_->before_file) impl_->file->log(level, "{}", printable(text));
  impl_->before_file.clear();
}

void Console::begin(const std::string& stage, int total) {
  const std::lock_guard lock(impl_->mutex);
  impl_->close_line();
  impl_->stage = {stage, total, 0, Clock::now(), -1};
  impl_->log(spdlog::level::info, stage + ": " + std::to_string(total));
  if (total > 0 && impl_->terminal) impl_->show_progress();
}

void Console::advance() {
  const std::lock_guard lock(impl_->mutex);
  ++impl_->stage.done;
  impl_->show_progress();
  if (impl_->stage.done == impl_->stage.total) impl_->log(spdlog::level::info, impl_->progress_text());
}

void Console::note(const std::string& sentence) {
  const std::lock_guard lock(impl_->mutex);
  impl_->log(spdlog::level::info, sentence);
  impl_->print("note", sentence, false);
}

void Console::warn(const std::string& sentence) {
  const std::lock_guard lock(impl_->mutex);
  impl_->log(spdlog::level::warn, sentence);
  impl_->print("warning", sentence, true);
}

void Console::say(const std::string& line) {
  const std::lock_guard lock(impl_->mutex);
  impl_->log(spdlog::level::info, line);
  impl_->print("result", line, true);
}

std::size_t resident_memory() {
  std::ifstream statm("/proc/self/statm");
  std::size_t size = 0, resident = 0;
  statm >> size >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGE_SIZE));
}

std::size_t peak_resident_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

}  // namespace skysweep::app
