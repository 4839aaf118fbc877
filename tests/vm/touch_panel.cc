// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A touch panel for two fingers, made in the kernel by uinput as a USB panel's driver would (multitouch
// protocol B). Unlike a panel of the virtual machine it can be had with more than one finger. Fingers do what
// the lines on standard input say, in steps of the panel (0 to 32767 both ways):
//   down FINGER X Y    move FINGER X Y    up FINGER
// The panel is unplugged when standard input ends. Exit code 1: no panel could be made, or a line made no
// sense.
#include <fcntl.h>
#include <linux/uinput.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <iostream>
#include <sstream>
#include <string>

namespace {

constexpr int kSteps = 32767;
constexpr int kFingers = 2;

class TouchPanel {
 public:
  bool plug() {
    device_ = open("/dev/uinput", O_WRONLY | O_CLOEXEC);
    if (device_ < 0) return false;
    bool good = true;
    const auto may = [&](unsigned long what, int code) { good = good && ioctl(device_, what, code) == 0; };
    may(UI_SET_EVBIT, EV_KEY);
    may(UI_SET_KEYBIT, BTN_TOUCH);
    may(UI_SET_EVBIT, EV_ABS);
    may(UI_SET_PROPBIT, INPUT_PROP_DIRECT);  // what is touched is what is seen: a panel, no pad
    for (const int axis : {ABS_X, ABS_Y, ABS_MT_POSITION_X, ABS_MT_POSITION_Y})
      good = good && has_axis(axis, kSteps);
    good = good && has_axis(ABS_MT_SLOT, kFingers - 1) && has_axis(ABS_MT_TRACKING_ID, 65535);
    uinput_setup setup{};
    setup.id.bustype = BUS_USB;
    setup.id.vendor = 0x1234;
    setup.id.product = 0x5678;
    std::strncpy(setup.name, "Relievo test touch panel", sizeof setup.name - 1);
    return good && ioctl(device_, UI_DEV_SETUP, &setup) == 0 && ioctl(device_, UI_DEV_CREATE) == 0;
  }
  ~TouchPanel() {
    if (device_ >= 0) close(device_);  // the kernel unplugs it
  }

  bool down(int finger, int x, int y) {
    return tell(EV_ABS, ABS_MT_SLOT, finger) && tell(EV_ABS, ABS_MT_TRACKING_ID, next_contact_++) &&
           place(finger, x, y) && (fingers_++ > 0 || tell(EV_KEY, BTN_TOUCH, 1)) && done();
  }
  bool move(int finger, int x, int y) {
    return tell(EV_ABS, ABS_MT_SLOT, finger) && place(finger, x, y) && done();
  }
  bool up(int finger) {
    return tell(EV_ABS, ABS_MT_SLOT, finger) && tell(EV_ABS, ABS_MT_TRACKING_ID, -1) &&
           (--fingers_ > 0 || tell(EV_KEY, BTN_TOUCH, 0)) && done();
  }

 private:
  bool has_axis(int axis, int maximum) {
    uinput_abs_setup setup{};
    setup.code = static_cast<__u16>(axis);
    setup.absinfo.maximum = maximum;
    return ioctl(device_, UI_ABS_SETUP, &setup) == 0;
  }
  bool tell(int type, int code, int value) {
    input_event event{};
    event.type = static_cast<__u16>(type);
    event.code = static_cast<__u16>(code);
    event.value = value;
    return write(device_, &event, sizeof event) == sizeof event;
  }
  bool place(int finger, int x, int y) {
    const bool alone =
        finger > 0 || (tell(EV_ABS, ABS_X, x) && tell(EV_ABS, ABS_Y, y));  // for who knows one finger only
    return alone && tell(EV_ABS, ABS_MT_POSITION_X, x) && tell(EV_ABS, ABS_MT_POSITION_Y, y);
  }
  bool done() { return tell(EV_SYN, SYN_REPORT, 0); }

  int device_ = -1;
  int next_contact_ = 1;
  int fingers_ = 0;
};

bool obey(TouchPanel& panel, const std::string& line) {
  std::istringstream words(line);
  std::string what;
  int finger = -1, x = 0, y = 0;
  if (!(words >> what >> finger) || finger < 0 || finger >= kFingers) return false;
  if (what == "up") return panel.up(finger);
  if (!(words >> x >> y)) return false;
  return what == "down" ? panel.down(finger, x, y) : what == "move" && panel.move(finger, x, y);
}

}  // namespace

int main() {
  TouchPanel panel;
  if (!panel.plug()) {
    std::perror("touch_panel: /dev/uinput: no panel can be made (modprobe uinput, as root)");
    return 1;
  }
  for (std::string line; std::getline(std::cin, line);) {
    if (obey(panel, line)) continue;
    std::cerr << "touch_panel: " << line << ": no such movement\n";
    return 1;
  }
  return 0;
}
