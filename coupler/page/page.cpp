#include "coupler/page/page.hpp"

#include <nlohmann/json.hpp>

namespace talus::page {

extern const char* const frame;
extern const char* const chart_script;

namespace {

std::string with(std::string text, const std::string& mark, const std::string& content) {
  const auto place = text.find(mark);
  return place == std::string::npos ? text : text.replace(place, mark.size(), content);
}

std::string escaped_html(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<')
      result += "&lt;";
    else if (c == '&')
      result += "&amp;";
    else
      result += c;
  }
  return result;
}

/// JSON inside of a script element: "</script>" in a text must not end it.
std::string script_safe(const nlohmann::json& data) {
  std::string text = data.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  for (auto place = text.find("</"); place != std::string::npos; place = text.find("</", place + 3))
    text.replace(place, 2, "<\\/");
  return text;
}

}  // namespace

std::string make(const std::string& body, const std::string& title, const nlohmann::json& data) {
  std::string text = with(frame, "@TITLE@", escaped_html(title));
  text = with(text, "@BODY@", body);
  text = with(text, "@DATA@", script_safe(data));
  return with(text, "@CHART_JS@", chart_script);
}

}  // namespace talus::page
