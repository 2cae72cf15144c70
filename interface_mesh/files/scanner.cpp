#include "interface_mesh/files/scanner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/errors.hpp"

namespace talus::mesh {

namespace {

constexpr std::string_view blanks = " \t\v\f";

/// std::from_chars takes no plus sign.
std::string_view without_plus(std::string_view text) {
  return text.size() > 1 && text[0] == '+' && text[1] != '-' ? text.substr(1) : text;
}

}  // namespace

Scanner::Scanner(std::string content, std::string name)
    : content_(std::move(content)), name_(std::move(name)) {
  if (content_.starts_with("\xEF\xBB\xBF")) next_ = 3;  // UTF-8's mark of the byte order
}

Scanner Scanner::open(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  if (!file) throw core::ConfigError(fmt::format("{}: cannot be opened", path.string()));
  return {std::move(content).str(), path.string()};
}

void Scanner::fail_at(int line, const std::string& message) const {
  throw core::ConfigError(fmt::format("{}:{}: {}", name_, line, message));
}

std::size_t Scanner::end_of_line(std::size_t from) const {
  return std::min(content_.find_first_of("\r\n", from), content_.size());
}

std::size_t Scanner::start_after(std::size_t end) const {
  if (end >= content_.size()) return content_.size();
  return end + (content_[end] == '\r' && end + 1 < content_.size() && content_[end + 1] == '\n' ? 2 : 1);
}

bool Scanner::next_line() {
  while (next_ < content_.size()) {
    at_ = next_;
    end_ = end_of_line(at_);
    next_ = start_after(end_);
    ++line_;
    if (!rest().empty()) return true;
  }
  at_ = end_ = content_.size();
  return false;
}

bool Scanner::continue_line(char mark) {
  const std::size_t last = content_.find_last_not_of(blanks, end_ == 0 ? 0 : end_ - 1);
  if (last == std::string::npos || last < at_ || content_[last] != mark || next_ >= content_.size())
    return false;
  const std::size_t end = end_of_line(next_);
  content_.replace(last, next_ - last, next_ - last, ' ');
  end_ = end;
  next_ = start_after(end);
  ++line_;
  return true;
}

void Scanner::cut_comment(char mark) {
  for (std::size_t k = at_; k < end_; ++k)
    if (content_[k] == mark && (k == at_ || blanks.find(content_[k - 1]) != std::string_view::npos)) end_ = k;
}

std::string_view Scanner::word() {
  const std::string_view left = rest();
  if (left.empty()) {
    at_ = end_;
    return left;
  }
  const std::string_view found = left.substr(0, left.find_first_of(blanks));
  at_ = static_cast<std::size_t>(found.data() - content_.data()) + found.size();
  return found;
}

std::string_view Scanner::word(const char* what) {
  const std::string_view found = word();
  if (found.empty()) fail(fmt::format("the line ends where {} is expected", what));
  return found;
}

std::string_view Scanner::rest() const {
  const std::string_view left = std::string_view(content_).substr(at_, end_ - at_);
  const std::size_t first = left.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return left.substr(first, left.find_last_not_of(blanks) + 1 - first);
}

double Scanner::to_real(std::string_view text, const char* what) const {
  const std::string_view digits = without_plus(text);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (end != digits.data() + digits.size() || error == std::errc::invalid_argument)
    fail(fmt::format("{} is '{}', which is no number of its kind", what, text));
  if (error == std::errc::result_out_of_range) value = std::strtod(std::string(digits).c_str(), nullptr);
  if (!std::isfinite(value)) fail(fmt::format("{} is not finite", what));
  return value;
}

std::int64_t Scanner::to_integer(std::string_view text, const char* what) const {
  const std::string_view digits = without_plus(text);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (end != digits.data() + digits.size() || error != std::errc{})
    fail(fmt::format("{} is '{}', which is no number of its kind", what, text));
  return value;
}

}  // namespace talus::mesh
