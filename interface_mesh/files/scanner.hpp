#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace talus::mesh {

/// A file held in memory and read once, line by line and word by word; lines may end in \n, \r\n or \r.
/// Numbers are read in double precision whatever the locale is. Every error names the file and the line.
class Scanner {
 public:
  Scanner(std::string content, std::string name);
  /// @throws core::ConfigError where the file cannot be read
  static Scanner open(const std::filesystem::path& path);

  /// @throws core::ConfigError "NAME:LINE: message"
  [[noreturn]] void fail(const std::string& message) const { fail_at(line_, message); }
  [[noreturn]] void fail_at(int line, const std::string& message) const;
  const std::string& name() const { return name_; }
  std::string_view content() const { return content_; }
  int line() const { return line_; }

  /// Moves to the next line that is not empty; false at the end of the file.
  bool next_line();
  /// Appends the line after this one to it, as formats do whose lines end in a backslash.
  bool continue_line(char mark);
  /// Leaves out what follows a word that begins with a mark in this line.
  void cut_comment(char mark);
  void skip_line() { at_ = end_; }
  /// The next word of this line; empty at its end.
  std::string_view word();
  /// @throws core::ConfigError where the line has no more words
  std::string_view word(const char* what);
  /// What is left of this line, without spaces at its ends.
  std::string_view rest() const;
  /// What follows this line, e.g. the binary part of a file.
  std::string_view after_line() const { return std::string_view(content_).substr(next_); }

  double real(const char* what) { return to_real(word(what), what); }
  std::int64_t integer(const char* what) { return to_integer(word(what), what); }
  double to_real(std::string_view text, const char* what) const;
  std::int64_t to_integer(std::string_view text, const char* what) const;

 private:
  std::size_t end_of_line(std::size_t from) const;
  std::size_t start_after(std::size_t end) const;

  std::string content_, name_;
  std::size_t at_ = 0, end_ = 0;  ///< what is left of this line
  std::size_t next_ = 0;          ///< where the next line starts
  int line_ = 0;
};

}  // namespace talus::mesh
