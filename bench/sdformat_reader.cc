// Reads every file named on standard input with libsdformat and prints the seconds it took: the peer of bench/descriptions.
#include <chrono>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include <sdf/sdf.hh>

int main(int argc, char **argv) {
  const std::string models = argc > 1 ? argv[1] : "";
  sdf::Console::Instance()->SetQuiet(true);
  sdf::ParserConfig config;
  config.SetFindCallback([&](const std::string &uri) {
    const std::string scheme = "model://";
    return uri.rfind(scheme, 0) == 0 ? models + "/" + uri.substr(scheme.size()) : std::string();
  });
  std::vector<std::string> files;
  for (std::string line; std::getline(std::cin, line);) files.push_back(line);
  const auto start = std::chrono::steady_clock::now();
  for (const auto &file : files) {
    sdf::Root root;
    root.Load(file, config);
  }
  std::printf("%.6f\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}
