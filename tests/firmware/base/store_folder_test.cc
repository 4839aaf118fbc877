// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the store is when nobody says otherwise.
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "firmware/base/settings.h"

namespace relievo::firmware {
namespace {

// As it was, afterwards.
class Variable {
 public:
  explicit Variable(const char* name) : name_(name) {
    if (const char* value = std::getenv(name)) before_ = value;
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() { set(before_ ? before_->c_str() : nullptr); }
  void set(const char* value) const {
    if (value != nullptr) ::setenv(name_, value, 1);
    else ::unsetenv(name_);
  }

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST(StoreFolder, IsInTheHomeOrNamed) {
  const Variable home("HOME"), data("XDG_DATA_HOME");
  home.set("/home/ada");
  data.set("/data");
  EXPECT_EQ(*store_folder({}), "/data/relievo");
  data.set(nullptr);
  EXPECT_EQ(*store_folder({}), "/home/ada/.local/share/relievo");
  for (const char* none : {static_cast<const char*>(nullptr), "", "here"}) {
    home.set(none);
    data.set(none);
    const auto nowhere = store_folder({});
    ASSERT_FALSE(nowhere) << "no store begins in whatever folder somebody stands in";
    EXPECT_NE(nowhere.error().what.view().find("--store DIR"), std::string_view::npos);
    EXPECT_EQ(*store_folder("store"), "store");
  }
}

}  // namespace
}  // namespace relievo::firmware
