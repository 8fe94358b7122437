// SPDX-License-Identifier: Apache-2.0
// What the server refuses: foreign pages, missing tokens, large and malformed messages, paths.
// acceptance: W5
#include <chrono>
#include <memory>

#include "studio/request_checks.h"
#include "studio/token.h"
#include "studio_client.h"

namespace oriel::studio {
namespace {

using Fields = TestSocket::Fields;

class StudioServerTest : public StudioTest {
 protected:
  bool upgrades(const Fields& headers, const std::string& host = {},
                const std::string& target = "/ws") {
    try {
      TestSocket socket(port, headers, host, target);
      return true;
    } catch (const boost::system::system_error&) {
      return false;
    }
  }
};

TEST_F(StudioServerTest, ForeignHostsAndOriginsAreRefused) {
  serve();
  EXPECT_EQ(status("/", host()), 200);
  EXPECT_EQ(status("/", "Host: localhost:" + std::to_string(port) + "\r\n"), 200);
  EXPECT_EQ(status("/", "Host: evil.test:" + std::to_string(port) + "\r\n"), 421);
  EXPECT_EQ(status("/", "Host: 127.0.0.1\r\n"), 421);
  EXPECT_EQ(status("/", host() + host()), 421) << "two hosts";
  EXPECT_EQ(status("/", ""), 421);
  for (const char* origin : {"http://evil.test", "null", "https://127.0.0.1", "http://127.0.0.1",
                             "http://127.0.0.1:1", ""})
    EXPECT_EQ(status("/", host() + "Origin: " + origin + "\r\n"), 403) << origin;
  EXPECT_EQ(status("/", host() + "Sec-Fetch-Site: cross-site\r\n"), 403);
  EXPECT_EQ(status("/", host() + "Origin: " + origin() + "\r\n"), 200);

  EXPECT_TRUE(upgrades({{"Origin", origin()}}));
  EXPECT_FALSE(upgrades({{"Origin", "null"}}));
  EXPECT_FALSE(upgrades({{"Origin", "http://evil.test"}}));
  EXPECT_FALSE(upgrades({})) << "neither origin nor token";
  EXPECT_TRUE(upgrades({{"X-Oriel-Token", token}}));
  EXPECT_FALSE(upgrades({{"X-Oriel-Token", token.substr(1) + "0"}}));
  EXPECT_FALSE(upgrades({{"Origin", origin()}}, "evil.test:" + std::to_string(port)));
  EXPECT_FALSE(upgrades({{"Origin", origin()}}, {}, "/other"));
}

TEST_F(StudioServerTest, ClientsWithoutTokenAreClosed) {
  serve();
  const Fields own = {{"Origin", origin()}};
  for (const json& first :
       {json{{"type", "hello"}}, json{{"type", "hello"}, {"token", "0"}},
        json{{"type", "hello"}, {"token", ""}}, json{{"type", "hello"}, {"token", 5}},
        json{{"type", "outline"}, {"token", token}}, json{{"type", "undo"}}}) {
    TestSocket socket(port, own);
    socket.send(first);
    EXPECT_EQ(socket.close_code(), 4000) << first;
  }
  TestSocket garbage(port, own);
  garbage.send_text("{\"type\": ");
  EXPECT_EQ(garbage.close_code(), 4002);
  // A client that says nothing is closed; the deadline is the server's.
  TestSocket silent(port, own);
  EXPECT_EQ(silent.close_code(), 4000);
}

TEST_F(StudioServerTest, ASecondClientReplacesTheFirst) {
  serve();
  const auto first = client();
  const auto second = client();
  EXPECT_EQ(first->close_code(), 4001);
  EXPECT_EQ(second->ask({{"type", "outline"}})["type"], "reply");
}

TEST_F(StudioServerTest, LargeAndMalformedMessagesAreRefused) {
  serve();
  {
    const auto large = client();
    large->send_text(json{{"type", "edit"}, {"x", std::string(70'000, 'x')}}.dump());
    EXPECT_EQ(large->close_code(), 1009) << "message too big";
  }
  const auto socket = client();
  EXPECT_EQ(socket->ask({{"type", "no such"}})["code"], "unknown-type");
  EXPECT_EQ(socket->ask({{"type", 5}})["code"], "bad-request");
  EXPECT_EQ(socket->ask({{"type", "pick"}})["code"], "bad-request");
  EXPECT_EQ(socket->ask({{"type", "pick"}, {"x", "a"}, {"y", 1}})["code"], "bad-request");
  EXPECT_EQ(socket->ask({{"type", "pick"}, {"x", 4000}, {"y", 1}})["code"], "bad-request");
  EXPECT_EQ(socket->ask({{"type", "edit"}, {"edits", "a"}})["code"], "bad-request");
  EXPECT_EQ(socket->ask({{"type", "edit"}, {"edits", {"nonsense"}}})["code"], "bad-edit");
  EXPECT_EQ(socket->ask({{"type", "edit"}, {"edits", {std::string(5000, 'x')}}})["code"],
            "too-large");
  EXPECT_EQ(socket->ask({{"type", "view"}, {"size", {1}}})["code"], "bad-request");
  EXPECT_EQ(socket->ask({{"type", "lux_grid"},
                         {"origin", {0, 0, 0}},
                         {"u", {1, 0, 0}},
                         {"v", {0, 1, 0}},
                         {"columns", 100000},
                         {"rows", 100000}})["code"],
            "too-large");
  std::string nested(30'000, '[');
  socket->send_text("{\"type\": \"view\", \"look\": " + nested);
  EXPECT_EQ(socket->close_code(), 4002);

  for (const char* bytes : {"\r\n\r\n", "GET\r\n\r\n", "GET / HTTP/9.9\r\n\r\n",
                            "\x16\x03\x01\x02\x00\x01", "GET / HTTP/1.1\r\nHost\r\n\r\n"})
    EXPECT_FALSE(raw(bytes).starts_with("HTTP/1.1 200"));
  const std::string long_header = host() + "X: " + std::string(20'000, 'x') + "\r\n";
  EXPECT_NE(status("/", long_header), 200);
  EXPECT_EQ(status("/", host()), 200) << "the server still answers";
}

TEST_F(StudioServerTest, PathsLeadToPageFilesOnly) {
  serve();
  std::filesystem::create_symlink(file("secret.txt"), file("page/link.html"));
  EXPECT_EQ(status("/main.js", host()), 200);
  for (const char* path :
       {"/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "//secret.txt",
        "/page/../../secret.txt", "/link.html", "/scene.mi", "/main.js%00.html", "/.",
        "/etc/passwd", "/main.js/", "/%", "/index.html/../../secret.txt"}) {
    EXPECT_EQ(status(path, host()), 404) << path;
    EXPECT_EQ(raw(std::string("GET ") + path + " HTTP/1.1\r\n" + host() + "\r\n").find("secret\n"),
              std::string::npos);
  }
}

TEST_F(StudioServerTest, UploadsStayBelowTheFolder) {
  serve();
  const auto post = [&](const std::string& name, const std::string& headers,
                        const std::string& body = "pixels") {
    const std::string answer =
        raw("POST /api/upload?name=" + name + " HTTP/1.1\r\n" + host() + headers +
            "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
    return std::pair(std::atoi(answer.substr(9).c_str()), answer);
  };
  const std::string right = "Origin: " + origin() + "\r\nX-Oriel-Token: " + token + "\r\n";
  EXPECT_EQ(post("a.png", "Origin: " + origin() + "\r\n").first, 403);
  EXPECT_EQ(post("a.png", "X-Oriel-Token: 00\r\n").first, 403);
  for (const char* name : {"../a.png", "..%2fa.png", "%2fetc%2fa.png", ".a.png", "", "a%00.png",
                           "a.sh", "a.mi", "a.so"})
    EXPECT_EQ(post(name, right).first, 400) << name;
  EXPECT_FALSE(std::filesystem::exists(file("textures/a.png")));
  EXPECT_NE(post("a.png", right).second.find("\"textures/a.png\""), std::string::npos);
  EXPECT_NE(post("a.png", right).second.find("\"textures/a.png\""), std::string::npos);
  EXPECT_NE(post("a.png", right, "other").second.find("\"textures/a-2.png\""), std::string::npos);
  EXPECT_EQ(text_of(file("textures/a.png")), "pixels");
  std::filesystem::remove_all(file("textures"));
  std::filesystem::create_directories(file("state/outside"));
  std::filesystem::create_directory_symlink("/tmp", file("textures"));
  EXPECT_EQ(post("oriel-outside.png", right).first, 403) << "a link out of the folder";
  const std::string announced = raw("POST /api/upload?name=b.png HTTP/1.1\r\n" + host() + right +
                                    "Content-Length: 999999999999\r\n\r\n");
  EXPECT_EQ(std::atoi(announced.substr(9).c_str()), 413);
  EXPECT_EQ(status("/api/upload?name=b.png", host() + right), 404) << "GET changes nothing";
}

TEST_F(StudioServerTest, FilesOfRequestsStayBelowTheFolder) {
  serve();
  const auto socket = client();
  for (const char* name : {"../out.exr", "/tmp/out.exr", "out.sh", ".exr", "a/b.exr"})
    EXPECT_EQ(socket->ask({{"type", "job"}, {"action", "start"}, {"file", name}})["code"],
              "outside")
        << name;
  for (const char* name : {"../x.mi", "/tmp/x.mi", "x.sh"})
    EXPECT_EQ(socket->ask({{"type", "save"}, {"mode", "incremental"}, {"file", name}})["code"],
              "outside")
        << name;
  EXPECT_EQ(
      socket->ask({{"type", "relink"}, {"texture", "t"}, {"file", "../../etc/passwd"}})["code"],
      "outside");
  EXPECT_EQ(socket->ask({{"type", "deliver"}, {"kind", "png"}, {"tone", "-o /tmp/x.png"}})["code"],
            "bad-request");
}

TEST_F(StudioServerTest, AnswersHaveTheHeadersOfThePolicy) {
  serve();
  const std::string answer = raw("GET / HTTP/1.1\r\n" + host() + "\r\n");
  for (const char* header :
       {"default-src 'none'", "script-src 'self'", "frame-ancestors 'none'",
        "X-Content-Type-Options: nosniff", "Referrer-Policy: no-referrer",
        "Cross-Origin-Resource-Policy: same-origin", "Cross-Origin-Opener-Policy: same-origin",
        "X-Frame-Options: DENY", "Content-Type: text/html"})
    EXPECT_NE(answer.find(header), std::string::npos) << header;
  EXPECT_EQ(answer.find("Access-Control-Allow"), std::string::npos);
}

TEST_F(StudioServerTest, OtherAddressesRequireInsecure) {
  const RunResult r = run({"studio", "scene.mi", "--listen", "0.0.0.0"});
  EXPECT_EQ(r.exit_code, 2);
  EXPECT_NE(r.err.find("--insecure"), std::string::npos);
}

TEST(StudioToken, HasManyBitsAndIsComparedAsAWhole) {
  const std::string token = make_token();
  EXPECT_EQ(token.size(), 64u);
  EXPECT_NE(token, make_token());
  EXPECT_TRUE(is_same_token(token, token));
  for (const std::string& other : {std::string(), token.substr(1), token + "0", token + token})
    EXPECT_FALSE(is_same_token(token, other));
  EXPECT_FALSE(is_same_token("", ""));
}

TEST(RequestChecks, PlainNames) {
  for (const char* name : {"a.png", "my wood_2-b.exr"}) EXPECT_TRUE(is_plain_name(name));
  for (const char* name : {"", ".", "..", "a/b", "a\\b", " a", "a\n", "\xc3\xa4.png", "a:b"})
    EXPECT_FALSE(is_plain_name(name)) << name;
  EXPECT_FALSE(is_plain_name(std::string(101, 'a')));
}

}  // namespace
}  // namespace oriel::studio
