#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

/// Pages in one file each: style, Chart.js, data and the script that draws it, with nothing to fetch.
namespace talus::page {

/// Puts a body (HTML with a script that reads the global `data`) into the common frame.
std::string make(const std::string& body, const std::string& title, const nlohmann::json& data);

}  // namespace talus::page
