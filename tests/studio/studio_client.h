// SPDX-License-Identifier: Apache-2.0
// Test support: a client of the server that can do everything wrong.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "support/program.h"

namespace oriel::studio {

namespace beast = boost::beast;
namespace net = boost::asio;
using nlohmann::json;

/// A WebSocket.
class TestSocket {
 public:
  using Fields = std::vector<std::pair<std::string, std::string>>;

  /// Throws boost::system::system_error if the server refuses.
  TestSocket(unsigned short port, const Fields& headers, const std::string& host = {},
             const std::string& target = "/ws")
      : stream_(io_) {
    stream_.next_layer().connect({net::ip::make_address("127.0.0.1"), port});
    stream_.read_message_max(64u << 20);
    stream_.set_option(beast::websocket::stream_base::decorator(
        [headers](beast::websocket::request_type& request) {
          for (const auto& [name, value] : headers) request.set(name, value);
        }));
    stream_.handshake(host.empty() ? "127.0.0.1:" + std::to_string(port) : host, target);
  }

  void send(const json& message) { send_text(message.dump()); }
  void send_text(const std::string& text) {
    stream_.text(true);
    stream_.write(net::buffer(text));
  }
  /// The next message; sets `binary`. Throws at the end.
  std::string read(bool& binary) {
    beast::flat_buffer buffer;
    stream_.read(buffer);
    binary = stream_.got_binary();
    return beast::buffers_to_string(buffer.data());
  }
  /// The next text message that `fits`, from those since the last request on.
  template <class F>
  json wait(const F& fits) {
    while (!before_answer_.empty()) {
      const json text = before_answer_.front();
      before_answer_.pop_front();
      if (fits(text)) return text;
    }
    return next(fits, [](const json&) {});
  }
  json wait_for(const std::string& type) {
    return wait([&](const json& m) { return m["type"] == type; });
  }
  /// Sends a request and returns its answer.
  json ask(json request) {
    request["id"] = ++id_;
    before_answer_.clear();
    send(request);
    return next([&](const json& m) { return m.contains("id") && m["id"] == id_; },
                [&](const json& m) { before_answer_.push_back(m); });
  }
  /// Reads until the server closes; returns its code.
  std::uint16_t close_code() {
    try {
      for (bool binary = false;;) read(binary);
    } catch (const boost::system::system_error&) {
    }
    return stream_.reason().code;
  }
  static std::uint32_t word(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i)
      value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
    return value;
  }

  std::vector<std::string> strips;
  bool acknowledges = true;

 private:
  /// As wait(), of messages to come; calls skip() with others. Pixels are acknowledged and counted.
  template <class F, class Skip>
  json next(const F& fits, const Skip& skip) {
    for (;;) {
      bool binary = false;
      const std::string message = read(binary);
      if (binary) {
        strips.push_back(message);
        const auto* bytes = reinterpret_cast<const unsigned char*>(message.data());
        if (acknowledges && (bytes[7] & 1) != 0)
          send({{"type", "ack"}, {"frame", word(message, 28)}});
        continue;
      }
      json text = json::parse(message);
      if (fits(text)) return text;
      skip(text);
    }
  }

  net::io_context io_;
  beast::websocket::stream<net::ip::tcp::socket> stream_;
  int id_ = 0;
  std::deque<json> before_answer_;  ///< messages between the last request and its answer
};

/// The program `oriel studio` in a temporary folder.
class StudioTest : public ProgramTest {
 protected:
  void SetUp() override {
    write("scene.mi", small_scene());
    write("page/index.html", "");
    std::filesystem::create_directories(file("page"));
    write("page/index.html", "<!doctype html><title>page</title>");
    write("page/main.js", "export {};");
    write("secret.txt", "secret");
    setenv("XDG_STATE_HOME", file("state").c_str(), 1);
  }
  void TearDown() override { stop(SIGTERM); }

  /// Starts the server and waits for its address.
  void serve(std::vector<std::string> words = {"scene.mi"}) {
    words.insert(words.begin(), "studio");
    words.insert(words.end(), {"--page", "page", "--threads", "2"});
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    process_ = fork();
    if (process_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      close(ends[0]), close(ends[1]);
      if (chdir(file("").c_str()) != 0) _exit(127);
      std::vector<char*> arguments = {const_cast<char*>("oriel")};
      for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
      arguments.push_back(nullptr);
      execv(ORIEL_PROGRAM, arguments.data());
      _exit(127);
    }
    close(ends[1]);
    std::string line;
    for (char c = 0; ::read(ends[0], &c, 1) == 1 && c != '\n';) line += c;
    close(ends[0]);
    ASSERT_TRUE(line.starts_with("http://127.0.0.1:")) << line;
    port = static_cast<unsigned short>(std::atoi(line.c_str() + 17));
    token = line.substr(line.find("token=") + 6);
  }

  int stop(int signal) {
    if (process_ <= 0) return 0;
    kill(process_, signal);
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = 0;
    return status;
  }

  std::string origin() const { return "http://127.0.0.1:" + std::to_string(port); }

  /// A connected client after `welcome`.
  std::unique_ptr<TestSocket> client() {
    auto socket = std::make_unique<TestSocket>(port, TestSocket::Fields{{"Origin", origin()}});
    socket->send({{"type", "hello"}, {"version", 1}, {"token", token}});
    socket->wait_for("welcome");
    return socket;
  }

  /// Sends bytes and returns all that the server answers.
  std::string raw(const std::string& request) const {
    net::io_context io;
    net::ip::tcp::socket socket(io);
    socket.connect({net::ip::make_address("127.0.0.1"), port});
    boost::system::error_code error;
    net::write(socket, net::buffer(request), error);
    socket.shutdown(net::ip::tcp::socket::shutdown_send, error);
    std::string answer;
    net::read(socket, net::dynamic_buffer(answer), error);
    return answer;
  }
  /// The status of a GET with these header lines; 0 if there is no answer.
  int status(const std::string& target, const std::string& headers) const {
    const std::string answer = raw("GET " + target + " HTTP/1.1\r\n" + headers + "\r\n");
    return answer.starts_with("HTTP/1.1 ") ? std::atoi(answer.c_str() + 9) : 0;
  }
  std::string host() const { return "Host: 127.0.0.1:" + std::to_string(port) + "\r\n"; }

  unsigned short port = 0;
  std::string token;
  pid_t process_ = 0;
};

}  // namespace oriel::studio
