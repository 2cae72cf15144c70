#include "dem_solver/scene/ascii_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/errors.hpp"
#include "core/input_file.hpp"
#include "dem_solver/scene/grid_checks.hpp"

namespace talus::dem {

namespace {

struct Token {
  std::string_view text;
  int line = 0;
};

/// The words of a text with their lines; lines end with a line feed, a carriage return, or both.
class Tokens {
 public:
  explicit Tokens(std::string_view text) : text_(text) { find(); }
  bool at_end() const { return token_.text.empty(); }
  const Token& peek() const { return token_; }
  Token take() {
    const Token taken = token_;
    find();
    return taken;
  }

 private:
  void find() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) {
      const bool pair = text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n';
      if ((text_[at_] == '\n' || text_[at_] == '\r') && !pair) ++line_;
      ++at_;
    }
    const std::size_t start = at_;
    while (at_ < text_.size() && !std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    token_ = {text_.substr(start, at_ - start), line_};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
  Token token_;
};

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return std::tolower(c); });
  return result;
}

/// NaN as C, R, Python and older Windows programs write it.
bool spells_missing(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  const std::string word = lower(text);
  return word.starts_with("nan") || word == "na" || word.starts_with("1.#qnan") || word.starts_with("1.#ind");
}

std::optional<double> number_in(std::string_view text) {
  if (spells_missing(text)) return std::numeric_limits<double>::quiet_NaN();
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || std::isinf(value)) return std::nullopt;
  return value;
}

struct HeaderValue {
  double number = 0;
  int line = 0;
};

class Reader {
 public:
  Reader(std::filesystem::path path, std::string text)
      : path_(std::move(path)), text_(std::move(text)), tokens_(text_) {}

  AsciiGrid read() {
    read_header();
    set_shape();
    read_heights();
    check_heights(grid_, [this](std::size_t height, const std::string& what) { fail_at(height, what); });
    return std::move(grid_);
  }

 private:
  static constexpr double most_nodes = 1e9;
  static constexpr double usual_missing = -9999;  // where the header does not say
  static constexpr double printed = 2e-6;         // of NODATA_value: single precision, six digits printed
  static constexpr std::array known{"ncols", "nrows", "xllcorner",    "yllcorner", "xllcenter", "yllcenter",
                                    "dx",    "dy",    "nodata_value", "nodata",    "cellsize"};

  [[noreturn]] void fail(int line, const std::string& what) const {
    throw core::ConfigError(
        fmt::format("{}{}: {}", path_.string(), line > 0 ? fmt::format(":{}", line) : "", what));
  }
  /// Finds the line of a height again, which nothing keeps.
  [[noreturn]] void fail_at(std::size_t height, const std::string& what) const {
    Tokens tokens = first_height_;
    for (std::size_t k = 0; k < height; ++k) tokens.take();
    fail(tokens.peek().line, what);
  }
  static std::string comma_hint(std::string_view text) {
    return text.find(',') == std::string_view::npos
               ? ""
               : "; decimals need a point, and numbers a blank between them";
  }

  void read_header() {
    while (!tokens_.at_end() && std::isalpha(static_cast<unsigned char>(tokens_.peek().text.front())) &&
           !spells_missing(tokens_.peek().text)) {
      const Token key = tokens_.take();
      const std::string name = lower(key.text);
      if (std::ranges::find(known, name) == known.end())
        fail(key.line, fmt::format("`{}` is no key of an Esri ASCII grid; known: ncols, nrows, xllcorner or "
                                   "xllcenter, yllcorner or yllcenter, cellsize or dx and dy, NODATA_value",
                                   key.text.substr(0, 40)));
      if (tokens_.at_end() || tokens_.peek().line != key.line)
        fail(key.line, fmt::format("the header's `{}` needs a number", key.text));
      const Token value = tokens_.take();
      const auto number = number_in(value.text);
      if (!number)
        fail(value.line, fmt::format("the header's `{}` needs a number, not '{}'{}", key.text,
                                     value.text.substr(0, 40), comma_hint(value.text)));
      if (!tokens_.at_end() && tokens_.peek().line == key.line)
        fail(key.line, fmt::format("the header's `{}` needs one number, not several", key.text));
      if (!header_.emplace(name, HeaderValue{*number, key.line}).second)
        fail(key.line, fmt::format("the header gives `{}` twice", key.text));
    }
    first_height_ = tokens_;
  }

  bool has(const char* key) const { return header_.contains(key); }
  const HeaderValue& header(const char* key) const {
    const auto found = header_.find(key);
    if (found == header_.end()) fail(0, fmt::format("the header has no `{}`", key));
    return found->second;
  }
  mesh::Index count(const char* key) const {
    const auto [n, line] = header(key);
    if (!(n >= 2 && n <= most_nodes) || n != std::floor(n))
      fail(line, fmt::format("`{}` must be a whole number of at least 2, but is {:.6g}", key, n));
    return static_cast<mesh::Index>(n);
  }
  double width(const char* key) const {
    const auto [width, line] = header(has(key) ? key : "cellsize");
    if (!(width > 0)) fail(line, fmt::format("`{}` must be greater than 0", has(key) ? key : "cellsize"));
    if (has(key) && has("cellsize") && header("cellsize").number != width)
      fail(line, fmt::format("`{}` contradicts `cellsize`", key));
    return width;
  }
  double first_middle(const char* middle, const char* corner, double width) const {
    if (has(middle) && has(corner))
      fail(header(middle).line, fmt::format("`{}` contradicts `{}`", middle, corner));
    return has(middle) ? header(middle).number : header(corner).number + 0.5 * width;
  }

  void set_shape() {
    grid_.columns = count("ncols");
    grid_.rows = count("nrows");
    if (static_cast<double>(grid_.columns) * grid_.rows > most_nodes)
      fail(0, "has more nodes than can be numbered");
    grid_.column_width = width("dx");
    grid_.row_width = width("dy");
    grid_.corner = {first_middle("xllcenter", "xllcorner", grid_.column_width),
                    first_middle("yllcenter", "yllcorner", grid_.row_width), 0};
    if (!grid_.corner.allFinite()) fail(0, "the header's corner must be finite");
  }

  void read_heights() {
    const double missing = has("nodata_value") ? header("nodata_value").number
                           : has("nodata")     ? header("nodata").number
                                               : usual_missing;
    const double width = printed * std::abs(missing);
    const std::size_t expected = static_cast<std::size_t>(grid_.columns) * grid_.rows;
    grid_.heights.reserve(std::min(expected, text_.size() / 2 + 1));  // a height takes two bytes at least
    while (!tokens_.at_end()) {
      const Token token = tokens_.take();
      const auto height = number_in(token.text);
      if (!height)
        fail(token.line, fmt::format("height {} is not a number: '{}'{}", grid_.heights.size() + 1,
                                     token.text.substr(0, 40), comma_hint(token.text)));
      grid_.heights.push_back(std::abs(*height - missing) <= width ? std::nan("") : *height);
    }
    if (grid_.heights.size() != expected)
      fail(0, fmt::format("has {} heights, but `ncols` times `nrows` is {}", grid_.heights.size(), expected));
  }

  std::filesystem::path path_;
  std::string text_;
  Tokens tokens_, first_height_ = tokens_;
  std::map<std::string, HeaderValue> header_;
  AsciiGrid grid_;
};

}  // namespace

AsciiGrid read_ascii_grid(const std::filesystem::path& path) {
  std::string text = core::text_of_file(path);
  core::drop_byte_order_mark(text);
  return Reader(path, std::move(text)).read();
}

}  // namespace talus::dem
