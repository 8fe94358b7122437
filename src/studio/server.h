// SPDX-License-Identifier: Apache-2.0
// The HTTP and WebSocket server of Oriel Studio.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "interactive/picture.h"

namespace oriel::studio {

struct ServerSettings {
  std::string address = "127.0.0.1";
  unsigned short port = 0;    ///< 0: chosen by the system
  int inherited_socket = -1;  ///< a listening socket instead of address and port
  std::string token;
  std::filesystem::path page;  ///< folder of the page
  std::string program_version;
};

/// An answer below /api/.
struct ApiAnswer {
  unsigned status = 200;
  std::string type = "application/json; charset=utf-8";
  std::shared_ptr<const std::string> body;
};
struct ApiRequest {
  bool post = false;
  std::string path;  ///< decoded, without /api
  std::string query;
  std::string body;
};

/// What the server serves. Called on the server's thread; must return soon.
class ServerHandler {
 public:
  ServerHandler() = default;
  ServerHandler(const ServerHandler&) = delete;
  ServerHandler& operator=(const ServerHandler&) = delete;
  virtual ~ServerHandler() = default;
  virtual void client_connected() = 0;
  virtual void client_left() = 0;
  /// A text message of an authenticated client, except `hello` and `ack`.
  virtual void text(const std::string& message) = 0;
  virtual ApiAnswer api(ApiRequest request) = 0;
  /// Maximum size of the body of a request.
  virtual std::size_t max_body(const std::string& path) const = 0;
  virtual std::shared_ptr<const interactive::Picture> picture() = 0;
};

/// Serves one client at a time.
///
/// Model:   one thread, that of run(). Each request is judged by its Host, Origin and token
///          (request_checks.h). Pixels are sent while the client has acknowledged all but two
///          frames; then the newest picture follows, so nothing piles up for slow clients.
/// Checked: StudioServerTest.* in tests/studio
class StudioServer {
 public:
  /// Errors:  std::runtime_error if the address cannot be used.
  StudioServer(ServerSettings settings, ServerHandler& handler);
  ~StudioServer();
  StudioServer(const StudioServer&) = delete;
  StudioServer& operator=(const StudioServer&) = delete;

  unsigned short port() const;
  std::string url() const;
  /// Serves until stop(); also ended by SIGINT and SIGTERM.
  void run();

  // From any thread:
  void stop();
  void send(std::string message);
  void picture_changed();

  struct State;  ///< of the implementation

 private:
  std::shared_ptr<State> state_;
};

/// A listening socket, which a child process can inherit. Returns its descriptor and the port.
/// Errors:  std::runtime_error.
std::pair<int, unsigned short> listen_on(const std::string& address, unsigned short port);

}  // namespace oriel::studio
