// SPDX-License-Identifier: Apache-2.0
// The only file that includes Boost.Beast.
#include "studio/server.h"

#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <chrono>
#include <deque>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "studio/message_queue.h"
#include "studio/page_files.h"
#include "studio/request_checks.h"
#include "studio/token.h"
#include "studio/wire.h"

namespace oriel::studio {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
namespace net = boost::asio;
using tcp = net::ip::tcp;
using json = nlohmann::json;
using boost::system::error_code;

namespace {

constexpr std::size_t kMaxMessage = 64 * 1024, kMaxConnections = 32, kMaxQueued = 64u << 20;
constexpr std::uint32_t kFramesInFlight = 2;
constexpr const char* kPong = R"({"type":"pong"})";
constexpr auto kTokenTime = std::chrono::seconds(5), kHeaderTime = std::chrono::seconds(10),
               kBodyTime = std::chrono::seconds(120);
enum CloseCode : std::uint16_t {
  kBadToken = 4000,
  kReplaced = 4001,
  kProtocol = 4002,
  kEnds = 4003
};

class WebClient;

}  // namespace

struct StudioServer::State : std::enable_shared_from_this<StudioServer::State> {
  State(ServerSettings s, ServerHandler& h)
      : settings(std::move(s)), handler(h), acceptor(io), signals(io), page(settings.page) {}

  void accept();
  void pump();

  ServerSettings settings;
  ServerHandler& handler;
  net::io_context io{1};
  tcp::acceptor acceptor;
  net::signal_set signals;
  PageFiles page;
  std::optional<OwnAddress> own;
  std::weak_ptr<WebClient> client;
  std::size_t connections = 0;
  std::atomic<bool> pump_posted = false;
  MessageQueue outgoing;  ///< to the client
  bool ending = false;
};

namespace {

using State = StudioServer::State;
using Stream = websocket::stream<beast::tcp_stream, false>;

/// A WebSocket client; authenticated by its first message.
class WebClient : public std::enable_shared_from_this<WebClient> {
 public:
  WebClient(beast::tcp_stream&& stream, std::shared_ptr<State> state)
      : state_(std::move(state)), stream_(std::move(stream)), timer_(state_->io) {
    ++state_->connections;
  }
  ~WebClient() { --state_->connections; }
  WebClient(const WebClient&) = delete;
  WebClient& operator=(const WebClient&) = delete;

  void start(const http::request<http::string_body>& request) {
    beast::get_lowest_layer(stream_).expires_never();
    stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    stream_.read_message_max(kMaxMessage);
    stream_.write_buffer_bytes(kMaxMessage);
    stream_.async_accept(request, [self = shared_from_this()](error_code error) {
      if (!error) self->opened();
    });
  }

  void send(std::string text) {
    queue({std::make_shared<const std::string>(std::move(text)), false});
  }

  void close(std::uint16_t code, const char* reason) {
    if (closing_) return;
    closing_ = true;
    reason_ = websocket::close_reason(static_cast<websocket::close_code>(code), reason);
    if (!writing_) write_close();
  }

  bool open() const { return authenticated_ && !closing_; }

  /// Sends the newest picture if the client keeps up.
  void pump() {
    if (!open() || frame_ - acknowledged_ >= kFramesInFlight || sending_pixels_ > 0) return;
    const std::shared_ptr<const interactive::Picture> picture = state_->handler.picture();
    if (!picture || picture->number == shown_) return;
    shown_ = picture->number;
    for (auto& strip : wire_strips(*picture, ++frame_)) {
      ++sending_pixels_;
      queue({std::move(strip), true});
    }
  }

 private:
  struct Message {
    std::shared_ptr<const std::string> bytes;
    bool binary = false;
  };

  void opened() {
    beast::get_lowest_layer(stream_).socket().set_option(tcp::no_delay(true));
    timer_.expires_after(kTokenTime);
    timer_.async_wait([weak = weak_from_this()](error_code error) {
      const auto self = weak.lock();
      if (!error && self && !self->authenticated_) self->close(kBadToken, "no token");
    });
    read();
  }

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
      if (error) return self->left();
      if (self->stream_.got_text()) self->received(beast::buffers_to_string(self->buffer_.data()));
      self->buffer_.consume(self->buffer_.size());
      if (!self->closing_) self->read();
    });
  }

  void received(const std::string& text) {
    const json message = json::parse(text, nullptr, false);
    if (!message.is_object()) return close(kProtocol, "no JSON object");
    const auto type = message.find("type");
    const std::string name =
        type != message.end() && type->is_string() ? type->get<std::string>() : std::string();
    if (!authenticated_) return authenticate(name, message);
    if (name == "ping") return queue({std::make_shared<const std::string>(kPong), false});
    if (name == "ack") {
      const auto frame = message.find("frame");
      if (frame == message.end() || !frame->is_number_unsigned()) return;
      const auto number = frame->get<std::uint64_t>();
      if (number <= frame_ && number > acknowledged_)
        acknowledged_ = static_cast<std::uint32_t>(number);
      return pump();
    }
    state_->handler.text(text);
  }

  void authenticate(const std::string& name, const json& message) {
    const auto token = message.find("token");
    if (name != "hello" || token == message.end() || !token->is_string() ||
        !is_same_token(state_->settings.token, token->get_ref<const std::string&>()))
      return close(kBadToken, "wrong token");
    if (const auto old = state_->client.lock()) {
      old->close(kReplaced, "another client has connected");
      state_->handler.client_left();
    }
    authenticated_ = true;
    timer_.cancel();
    state_->outgoing.take();  // they are for the client before
    state_->client = weak_from_this();
    state_->handler.client_connected();
    pump();
  }

  void queue(Message message) {
    if (closing_) return;
    queued_ += message.bytes->size();
    if (queued_ > kMaxQueued) return close(kProtocol, "too slow");
    messages_.push_back(std::move(message));
    if (!writing_) write();
  }

  void write() {
    if (closing_) return write_close();
    if (messages_.empty()) return;
    writing_ = true;
    stream_.binary(messages_.front().binary);
    stream_.async_write(
        net::buffer(*messages_.front().bytes),
        [self = shared_from_this()](error_code error, std::size_t) { self->written(error); });
  }

  void written(error_code error) {
    writing_ = false;
    if (error) return left();
    queued_ -= messages_.front().bytes->size();
    if (messages_.front().binary) --sending_pixels_;
    messages_.pop_front();
    if (messages_.empty() && !closing_) pump();
    if (!writing_) write();
  }

  void write_close() {
    if (std::exchange(close_sent_, true)) return;
    writing_ = true;
    stream_.async_close(reason_, [self = shared_from_this()](error_code) { self->left(); });
  }

  void left() {
    closing_ = true;
    timer_.cancel();
    if (!authenticated_) return;
    authenticated_ = false;
    if (state_->client.lock().get() != this) return;
    state_->client.reset();
    state_->handler.client_left();
  }

  std::shared_ptr<State> state_;
  Stream stream_;
  net::steady_timer timer_;
  beast::flat_buffer buffer_;
  std::deque<Message> messages_;
  websocket::close_reason reason_;
  std::size_t queued_ = 0, sending_pixels_ = 0;
  std::uint64_t shown_ = 0;
  std::uint32_t frame_ = 0, acknowledged_ = 0;
  bool authenticated_ = false, writing_ = false, closing_ = false, close_sent_ = false;
};

/// One HTTP connection until it becomes a WebSocket.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(tcp::socket&& socket, std::shared_ptr<State> state)
      : state_(std::move(state)), stream_(std::move(socket)) {
    ++state_->connections;
  }
  ~HttpConnection() { --state_->connections; }
  HttpConnection(const HttpConnection&) = delete;
  HttpConnection& operator=(const HttpConnection&) = delete;

  void read() {
    parser_.emplace();
    parser_->header_limit(8 * 1024);
    // Set below, once the path is known. Beast 1.74 compares wrongly without a limit.
    parser_->body_limit(std::numeric_limits<std::uint64_t>::max());
    stream_.expires_after(kHeaderTime);
    http::async_read_header(stream_, buffer_, *parser_,
                            [self = shared_from_this()](error_code error, std::size_t) {
                              if (error == http::error::end_of_stream) return self->shut();
                              if (error) return self->malformed(error);
                              self->header_read();
                            });
  }

 private:
  using Request = http::request<http::string_body>;

  void malformed(error_code error) {
    if (error.category() != http::make_error_code(http::error::bad_method).category()) return;
    answer(400, "text/plain; charset=utf-8", std::make_shared<const std::string>("bad request\n"),
           {}, true);
  }

  static const std::string* field(const Request& request, beast::string_view name,
                                  std::string& storage) {
    const auto found = request.find(name);
    if (found == request.end()) return nullptr;
    storage = std::string(found->value());
    return &storage;
  }

  void header_read() {
    const Request& request = parser_->get();
    target_ = std::string(request.target());
    const bool api = target_.starts_with("/api/");
    const bool upgrade = websocket::is_upgrade(request);
    std::string host, origin, site, token;
    RequestHeaders headers;
    headers.host = request.count(http::field::host) == 1 ? field(request, "Host", host) : nullptr;
    headers.origin = field(request, "Origin", origin);
    headers.fetch_site = field(request, "Sec-Fetch-Site", site);
    const std::string* given = field(request, "X-Oriel-Token", token);
    headers.has_token = given && is_same_token(state_->settings.token, *given);
    const Verdict verdict = judge(*state_->own, headers, api || upgrade);
    if (verdict != Verdict::Accepted) return fail(static_cast<unsigned>(verdict), "refused");
    if (api && !headers.has_token) return fail(403, "the token is missing or wrong");
    if (upgrade) return open_socket();
    const bool post = request.method() == http::verb::post;
    if (post ? !api : request.method() != http::verb::get) return fail(405, "method not allowed");
    const std::string path = target_.substr(0, target_.find('?'));
    const std::size_t most = post ? state_->handler.max_body(path.substr(4)) : 0;
    parser_->body_limit(most);
    if (parser_->content_length() && *parser_->content_length() > most)
      return fail(413, "the body is too large");
    stream_.expires_after(kBodyTime);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](error_code error, std::size_t) {
                       if (error == http::error::body_limit)
                         return self->fail(413, "the body is too large");
                       if (error) return;
                       self->serve();
                     });
  }

  void open_socket() {
    if (target_ != "/ws") return fail(404, "there is no such socket");
    Request request = parser_->release();
    stream_.expires_never();
    std::make_shared<WebClient>(std::move(stream_), state_)->start(request);
  }

  void serve() {
    const std::size_t mark = target_.find('?');
    const std::string path = percent_decoded(std::string_view(target_).substr(0, mark));
    const std::string query = mark == std::string::npos ? "" : target_.substr(mark + 1);
    if (path.starts_with("/api/")) {
      ApiAnswer a = state_->handler.api({parser_->get().method() == http::verb::post,
                                         path.substr(4), query, std::move(parser_->get().body())});
      return answer(a.status, a.type, a.body, {}, false);
    }
    const std::optional<PageFile> file = state_->page.find(path);
    if (!file) return fail(404, "there is no such file");
    if (parser_->get()[http::field::if_none_match] == file->tag)
      return answer(304, file->type, nullptr, file->tag, false);
    answer(200, file->type, std::make_shared<const std::string>(file->bytes), file->tag, false);
  }

  void fail(unsigned status, const std::string& message) {
    const json body = {{"type", "error"}, {"code", "http"}, {"message", message}};
    answer(status, "application/json; charset=utf-8",
           std::make_shared<const std::string>(body.dump()), {}, true);
  }

  void answer(unsigned status, std::string_view type, std::shared_ptr<const std::string> body,
              const std::string& tag, bool last) {
    auto response = std::make_shared<http::response<http::string_body>>();
    response->version(11);
    response->result(status);
    const auto set = [&](beast::string_view name, const std::string& value) {
      response->set(name, value);
    };
    set("Content-Type", std::string(type));
    set("Content-Security-Policy",
        "default-src 'none'; script-src 'self'; style-src 'self'; worker-src 'self'; img-src "
        "'self' blob: data:; font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors "
        "'none'; connect-src 'self' " +
            state_->own->websocket_sources());
    set("X-Content-Type-Options", "nosniff");
    set("Referrer-Policy", "no-referrer");
    set("Cross-Origin-Resource-Policy", "same-origin");
    set("Cross-Origin-Opener-Policy", "same-origin");
    set("X-Frame-Options", "DENY");
    if (tag.empty()) {
      set("Cache-Control", "no-store");
    } else {
      set("Cache-Control", "no-cache");
      set("ETag", tag);
    }
    response->keep_alive(!last);
    if (body) response->body() = *body;
    response->prepare_payload();
    stream_.expires_after(kBodyTime);
    http::async_write(stream_, *response,
                      [self = shared_from_this(), response, last](error_code error, std::size_t) {
                        if (error) return;
                        if (last) return self->shut();
                        self->read();
                      });
  }

  void shut() {
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  }

  std::shared_ptr<State> state_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::string target_;
};

tcp::endpoint endpoint_of(const std::string& address, unsigned short port) {
  error_code error;
  const net::ip::address ip = net::ip::make_address(address, error);
  if (error) throw std::runtime_error("\"" + address + "\" is not an IP address");
  return {ip, port};
}

}  // namespace

void StudioServer::State::accept() {
  acceptor.async_accept([self = shared_from_this()](error_code error, tcp::socket socket) {
    if (error == net::error::operation_aborted || self->ending) return;
    if (!error && self->connections < kMaxConnections)
      std::make_shared<HttpConnection>(std::move(socket), self)->read();
    self->accept();
  });
}

void StudioServer::State::pump() {
  if (const auto now = client.lock()) now->pump();
}

std::pair<int, unsigned short> listen_on(const std::string& address, unsigned short port) {
  net::io_context io;
  tcp::acceptor acceptor(io);
  const tcp::endpoint endpoint = endpoint_of(address, port);
  error_code error;
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(net::socket_base::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(net::socket_base::max_listen_connections, error);
  if (error)
    throw std::runtime_error("cannot listen on " + address + ":" + std::to_string(port) + ": " +
                             error.message());
  const unsigned short chosen = acceptor.local_endpoint().port();
  return {acceptor.release(), chosen};
}

StudioServer::StudioServer(ServerSettings settings, ServerHandler& handler) {
  int socket = settings.inherited_socket;
  const tcp::endpoint endpoint = endpoint_of(settings.address, settings.port);
  if (socket < 0) socket = listen_on(settings.address, settings.port).first;
  state_ = std::make_shared<State>(std::move(settings), handler);
  state_->acceptor.assign(endpoint.protocol(), socket);
  const bool loopback = endpoint.address().is_loopback();
  state_->own.emplace(port(), loopback ? std::string() : state_->settings.address);
}

StudioServer::~StudioServer() {
  if (const auto client = state_->client.lock()) state_->client.reset();
}

unsigned short StudioServer::port() const { return state_->acceptor.local_endpoint().port(); }

std::string StudioServer::url() const {
  const std::string& address = state_->settings.address;
  const std::string host = address.find(':') == std::string::npos ? address : "[" + address + "]";
  return "http://" + host + ":" + std::to_string(port()) + "/#token=" + state_->settings.token;
}

void StudioServer::run() {
  error_code error;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) state_->signals.add(number, error);
  state_->signals.async_wait([this](error_code e, int) {
    if (!e) stop();
  });
  state_->accept();
  state_->io.run();
}

void StudioServer::stop() {
  net::post(state_->io, [state = state_] {
    if (std::exchange(state->ending, true)) return;
    error_code ignored;
    state->acceptor.close(ignored);
    state->signals.cancel(ignored);
    if (const auto client = state->client.lock()) client->close(kEnds, "the server ends");
    auto timer = std::make_shared<net::steady_timer>(state->io, std::chrono::seconds(1));
    timer->async_wait([state, timer](error_code) { state->io.stop(); });
  });
}

void StudioServer::send(std::string message) {
  state_->outgoing.push(std::move(message));
  net::post(state_->io, [state = state_] {
    std::vector<std::string> messages = state->outgoing.take();
    if (const auto client = state->client.lock())
      for (std::string& message : messages) client->send(std::move(message));
  });
}

void StudioServer::picture_changed() {
  if (state_->pump_posted.exchange(true)) return;
  net::post(state_->io, [state = state_] {
    state->pump_posted = false;
    state->pump();
  });
}

}  // namespace oriel::studio
