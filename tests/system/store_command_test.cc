// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// `relievo store`, as whoever looks after a device types it.
#include <filesystem>

#include "tests/system/relievo_process.h"

namespace relievo::test {
namespace {

class StoreCommand : public RelievoProcess {
 protected:
  // Writes the words down and types the two that are asked for, or others.
  Said make_words(const std::string& store, bool rightly) {
    write_text(here / "type.sh", "coproc \"" RELIEVO_BINARY "\" store recovery-words --store " + store + R"(
pid=$COPROC_PID
exec 3<&${COPROC[0]} 4>&${COPROC[1]}
while read -r line <&3; do
  echo "$line"
  case $line in
    [0-9]*.*) words[${line%%.*}]=${line#*. } ;;
    "Write them"*) echo "${words[*]}" > words
                   grep -E 'core file size' /proc/$pid/limits > limits ;;
    "Type word"*) number=${line#Type word }; number=${number%:}
                  )" + (rightly ? "echo ${words[$number]} >&4" : "echo wrong >&4") +
                                     R"( ;;
  esac
done
wait $pid)");
    return run_program({"/bin/bash", "type.sh"}, here.path());
  }
};

// A umask may keep others out, never the program itself.
TEST_F(StoreCommand, NoUmaskTakesItsOwnFilesAway) {
  done({"simulate", "board", "--pairs", "1", "--scale", "0.5", "-o", "board"});
  const Said said = run_program(
      {"/bin/sh", "-c",
       "umask 777; exec \"" RELIEVO_BINARY "\" calibration import board/rig.yml --store new/store"},
      here.path());
  EXPECT_EQ(said.exit_code, 0) << said.err;
  const auto mode = [this](const char* name) { return std::filesystem::status(here / name).permissions(); };
  EXPECT_EQ(mode("new"), std::filesystem::perms(0700));
  EXPECT_EQ(mode("new/store"), std::filesystem::perms(0700));
  for (const char* name : {"relievo.db", "relievo.key", "relievo.lock", "relievo.reserve"})
    EXPECT_EQ(mode((std::string("new/store/") + name).c_str()), std::filesystem::perms(0600)) << name;
}

TEST_F(StoreCommand, KeepsCopiesKeysAndWords) {
  refused({"store", "check", "--store", "store"}, "store", "there is no store");
  refused({"store", "backup", "copy", "--store", "store"}, "store", "there is no store");
  refused({"store", "rekey", "--store", "store"}, "store", "there is no store");
  // A store with nobody in it, its key on another device.
  std::filesystem::create_directory(here / "stick");
  done({"simulate", "board", "--pairs", "1", "--scale", "0.5", "-o", "board"});
  const Said first =
      done({"calibration", "import", "board/rig.yml", "--store", "store", "--key", "stick/key"});
  EXPECT_NE(first.out.find("its key lies apart from the store"), std::string::npos) << first.out;
  EXPECT_NE(first.out.find("whoever takes both"), std::string::npos) << first.out;
  EXPECT_EQ(done({"calibration", "list", "--store", "store", "--key", "stick/key"}).out.find("its key"),
            std::string::npos)
      << "said once";
  // Where the disk was full, the first start has left an empty file.
  std::filesystem::create_directory(here / "begun");
  write_text(here / "begun/relievo.db", "");
  EXPECT_NE(done({"calibration", "import", "board/rig.yml", "--store", "begun"}).out.find("its key"),
            std::string::npos);
  EXPECT_NE(done({"memory", "--store", "begun"}).out.find("no visit"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(here / "store/relievo.key"));
  refused({"calibration", "list", "--store", "store"}, "relievo.key",
          "put it back, or name its place (--key)");

  done({"store", "rekey", "--store", "store", "--key", "stick/key", "--new-key", "store/relievo.key"});
  const Said old_key = relievo({"store", "check", "--store", "store", "--key", "stick/key"});
  EXPECT_EQ(old_key.exit_code, 1);
  EXPECT_NE(old_key.err.find("not the key of this store"), std::string::npos) << old_key.err;
  EXPECT_NE(done({"store", "check", "--store", "store"}).out.find("in order"), std::string::npos);

  // Moved once more: what lies beside the store opens only copies made before, and is said to.
  const Said moved = done({"store", "rekey", "--store", "store", "--new-key", "stick/third"});
  EXPECT_NE(moved.out.find("store/relievo.key is the old key"), std::string::npos) << moved.out;
  EXPECT_NE(moved.out.find("--key stick/third"), std::string::npos) << moved.out;
  std::filesystem::remove(here / "store/relievo.key");
  const Said back =
      done({"store", "rekey", "--store", "store", "--key", "stick/third", "--new-key", "store/relievo.key"});
  EXPECT_EQ(back.out.find("is the old key"), std::string::npos) << back.out;

  // A service of systemd finds its credential by the environment.
  std::filesystem::create_directory(here / "credentials");
  std::filesystem::rename(here / "store/relievo.key", here / "credentials/relievo.key");
  const Said credential =
      run_program({"/usr/bin/env", "CREDENTIALS_DIRECTORY=" + (here / "credentials").string(), RELIEVO_BINARY,
                   "store", "check", "--store", "store"},
                  here.path());
  EXPECT_EQ(credential.exit_code, 0) << credential.err;
  std::filesystem::rename(here / "credentials/relievo.key", here / "store/relievo.key");

  const Said wrong = make_words("store", false);
  EXPECT_NE(wrong.exit_code, 0);
  EXPECT_NE(wrong.err.find("nothing was changed"), std::string::npos) << wrong.err;
  const Said right = make_words("store", true);
  EXPECT_EQ(right.exit_code, 0) << right.out << right.err;
  EXPECT_NE(right.out.find("These words open the store from now on"), std::string::npos) << right.out;

  EXPECT_NE(done({"store", "backup", "copy.db", "--store", "store"}).out.find("copied to"),
            std::string::npos);
  EXPECT_NE(
      done({"store", "check", "--backup", "copy.db", "--store", "store"}).out.find("nobody in this copy"),
      std::string::npos);
  std::filesystem::create_directory(here / "board2");
  std::filesystem::copy(here / "copy.db", here / "board2/relievo.db");
  EXPECT_NE(
      relievo({"store", "check", "--store", "board2"}).err.find("relievo.key: the store's key is not there"),
      std::string::npos);
  const Said recovered = run_program(
      {"/bin/sh", "-c", "\"" RELIEVO_BINARY "\" store recover --store board2 < words"}, here.path());
  EXPECT_EQ(recovered.exit_code, 0) << recovered.err;
  EXPECT_NE(done({"calibration", "list", "--store", "board2"}).out.find("rig.yml"), std::string::npos);
  EXPECT_NE(
      run_program({"/bin/sh", "-c", "echo zoo zoo | \"" RELIEVO_BINARY "\" store recover --store board2"},
                  here.path())
          .err.find("twelve words"),
      std::string::npos);
}

// Their names are ordinary ones to every other command.
TEST_F(StoreCommand, NoOtherCommandWritesOverItsFiles) {
  done({"simulate", "board", "--pairs", "1", "--scale", "0.5", "-o", "board"});
  done({"calibration", "import", "board/rig.yml", "--store", "store"});
  const std::string key = read_text(here / "store/relievo.key");
  const std::string own = "a store's own files";
  refused({"calibration", "export", "1", "-o", "store/relievo.key", "--store", "store"}, "store/relievo.key",
          own);
  refused({"calibrate", "board", "--corners", "10x7", "--square-mm", "20", "-o", "store/relievo.db"},
          "store/relievo.db", own);
  refused({"calibrate", "--print-pattern", "chessboard", "--corners", "10x7", "--square-mm", "20", "-o",
           "store/board.pdf"},
          "store/board.pdf", own);
  refused({"reconstruct", "board/left1.png", "board/right1.png", "--calibration", "board/rig.yml", "-o",
           "out", "--save", "store/relievo.db"},
          "store/relievo.db", own);
  EXPECT_EQ(read_text(here / "store/relievo.key"), key);
  done({"store", "check", "--store", "store"});
  const std::string log = done({"store", "log", "--store", "store"}).out;
  EXPECT_TRUE(log.starts_with("1  20")) << log;
  EXPECT_NE(log.find("  calibration.saved  1\n"), std::string::npos) << log;
}

// A limit of the shell's is a disk that is full, not the end of the program.
TEST_F(StoreCommand, AFileSizeLimitIsAnErrorLikeAFullDisk) {
  done({"simulate", "board", "--pairs", "1", "--scale", "0.5", "-o", "board"});
  done({"calibration", "import", "board/rig.yml", "--store", "store"});
  std::filesystem::create_directory(here / "copies");
  const Said said =
      run_program({"/bin/bash", "-c",
                   "ulimit -f 40; exec \"" RELIEVO_BINARY "\" store backup copies/copy.db --store store"},
                  here.path());
  EXPECT_EQ(said.exit_code, 1) << said.err;
  EXPECT_NE(said.err.find("full"), std::string::npos) << said.err;
  EXPECT_EQ(listing(here / "copies"), "");
}

// Words and keys are in it while it runs.
TEST_F(StoreCommand, LeavesNoPictureOfItsMemory) {
  done({"simulate", "board", "--pairs", "1", "--scale", "0.5", "-o", "board"});
  done({"calibration", "import", "board/rig.yml", "--store", "store"});
  make_words("store", true);
  const std::string limits = read_text(here / "limits");
  EXPECT_NE(limits.find("0                    0"), std::string::npos) << limits;
}

}  // namespace
}  // namespace relievo::test
