// Files are replaced whole or not at all, and those that belong together together.
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "filled_artifact.h"
#include "io/artifacts.h"
#include "io/publish.h"
#include "own_folder.h"
#include "refusal.h"

using namespace whine;
namespace fs = std::filesystem;

TEST_CASE("a page and its table are both replaced, or both stay, and nothing is left beside them") {
  const OwnFolder folder;
  publish_all({{"table.tsv", "old"}, {"page.html", "old"}});
  CHECK(read_bytes("table.tsv") == "old");
  // A folder stands where the second belongs: nothing can be put there.
  fs::remove("page.html");
  fs::create_directories("page.html/inside");
  CHECK_THROWS_AS(publish_all({{"table.tsv", "new"}, {"page.html", "new"}}), Error);
  CHECK(read_bytes("table.tsv") == "old");
  fs::remove_all("page.html");
  publish_all({{"table.tsv", "new"}, {"page.html", "new"}});
  CHECK(read_bytes("table.tsv") == "new");
  CHECK(read_bytes("page.html") == "new");
  CHECK(folder.names() == std::vector<std::string>{"page.html", "table.tsv"});
}

TEST_CASE(
    "what a killed process left beside a file goes with its next write; what a living one or another machine writes stays") {
  OwnFolder folder;
  const pid_t gone = fork();
  if (gone == 0) _exit(0);
  REQUIRE(waitpid(gone, nullptr, 0) == gone);  // its number is free now
  char host[256] = {};
  REQUIRE(gethostname(host, sizeof host - 1) == 0);
  const std::string own = text(".tmp.", host, ".");
  const std::string stale = text("x.txt", own, gone), living = text("x.txt", own, getppid()),
                    of_another = text("y.txt", own, gone), of_none = text("x.txt", own, "notes"),
                    elsewhere = text("x.txt.tmp.not-", host, ".", gone), nowhere = text("x.txt.tmp.", gone);
  for (const std::string& name : {stale, living, of_another, of_none, elsewhere, nowhere})
    folder.file(name, "half");
  publish("x.txt", "whole");
  CHECK_FALSE(fs::exists(stale));
  CHECK(fs::exists(living));
  CHECK(fs::exists(of_another));
  CHECK(fs::exists(of_none));
  CHECK(fs::exists(elsewhere));
  CHECK(fs::exists(nowhere));  // it does not say on which machine its process was
  CHECK(read_bytes("x.txt") == "whole");
}

TEST_CASE("what is no regular file is rejected and not waited for") {
  OwnFolder folder;
  REQUIRE(mkfifo("pipe", 0600) == 0);
  ::alarm(20);  // a reader of such files does not come back by itself
  for (const std::string name : {"pipe", "/dev/zero", "/dev/null"}) {
    CHECK(refused([&] { read_bytes(name, "look elsewhere"); }, Failure::io,
                  {name, "regular", "look elsewhere"}));
  }
  CHECK(refused([] { read_bytes(".", "look elsewhere"); }, Failure::io, {".", "folder", "look elsewhere"}));
  fs::create_symlink("x.txt", "link");
  publish("x.txt", "whole");
  CHECK(read_bytes("link") == "whole");
  ::alarm(0);
}

TEST_CASE("writing is all or nothing: a failure leaves the earlier file and no rubbish") {
  OwnFolder folder;
  publish("out/a/x.txt", "earlier");
  CHECK(folder.names("out/a") == std::vector<std::string>{"x.txt"});

  SUBCASE("a full disk (file size limit)") {
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{}, small{};
    getrlimit(RLIMIT_FSIZE, &before);
    small = before;
    small.rlim_cur = 1000;
    setrlimit(RLIMIT_FSIZE, &small);
    const Refusal full = refusal_of([] { publish("out/a/x.txt", std::string(5000, 'n')); });
    const Failure artifact = failure_of([] { write("out/a/x.h5", any<SystemStaticResult>(), kMade); });
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    CHECK(full.kind == Failure::io);
    CHECK(names(full.message, {"out/a/x.txt", "File too large"}));
    CHECK(artifact == Failure::io);
  }
  SUBCASE("a folder in the place of the file") {
    fs::create_directory("out/a/folder");
    CHECK(failure_of([] { publish("out/a/folder", "new"); }) == Failure::io);
    fs::remove("out/a/folder");
  }
  SUBCASE("a file in the place of the folder") {
    CHECK(failure_of([] { publish("out/a/x.txt/y", "new"); }) == Failure::io);
  }
  CHECK(read_bytes("out/a/x.txt") == "earlier");
  CHECK(folder.names("out/a") == std::vector<std::string>{"x.txt"});
}

TEST_CASE("an unchanged file or link is left alone, a changed one replaced") {
  OwnFolder folder;
  CHECK(publish_if_changed("p/a.toml", "one"));
  CHECK_FALSE(publish_if_changed("p/a.toml", "one"));
  CHECK(publish_if_changed("p/a.toml", "two"));
  CHECK(read_bytes("p/a.toml") == "two");
  CHECK(publish_link("p/link", "a.toml"));
  CHECK_FALSE(publish_link("p/link", "a.toml"));
  CHECK(publish_link("p/link", "b.toml"));
  CHECK(fs::read_symlink("p/link") == "b.toml");
  CHECK(failure_of([] { publish_link("p/a.toml", "b.toml"); }) == Failure::io);
  CHECK(read_bytes("p/a.toml") == "two");
}
