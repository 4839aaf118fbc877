// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/screens/service/fault_words.h"

namespace relievo::ui {

const char* words_of(const Words& tr, Errc code) {
  switch (code) {
    case Errc::InvalidInput:
      return tr("This cannot be used");
    case Errc::NotFound:
      return tr("Something is missing");
    case Errc::Timeout:
      return tr("It took too long");
    case Errc::Disconnected:
      return tr("A device was pulled out or does not answer");
    case Errc::NotCalibrated:
      return tr("The cameras must be calibrated");
    case Errc::NoFace:
      return tr("No face found");
    case Errc::TooFewMatches:
      return tr("Too little could be matched");
    case Errc::PoorGeometry:
      return tr("The measurement is not good enough");
    case Errc::LibraryFailed:
      return tr("The program could not finish this");
    case Errc::OutOfMemory:
      return tr("Not enough memory");
    case Errc::MediaMissing:
      return tr("There is no stick. Plug one in, then try again.");
    case Errc::MediaFull:
      return tr("There is no room left");
    case Errc::StoreCorrupt:
      return tr("The store is damaged");
    case Errc::StoreNewer:
      return tr("The store is from a newer version");
    case Errc::IoFailed:
      return tr("Reading or writing failed");
    case Errc::Cancelled:
      return tr("It was stopped");
    case Errc::InvalidState:
      return tr("This is not possible now");
    case Errc::Unsupported:
      return tr("This device cannot do that");
  }
  return "";
}

LogWords words_of(const Words& tr, LogEvent event) {
  switch (event) {
    case LogEvent::Started:
      return {tr("Started")};
    case LogEvent::SignedOut:
      return {tr("Signed out")};
    case LogEvent::TechnicianSignedIn:
      return {tr("Signed in: {}"), tr("Technician")};
    case LogEvent::OperatorSignedIn:
      return {tr("Signed in: {}"), tr("Operator")};
    case LogEvent::WrongPin:
      return {tr("A wrong PIN was typed")};
    case LogEvent::ClockSet:
      return {tr("The clock was set")};
    case LogEvent::TechnicianPinChosen:
      return {tr("A new PIN was chosen: {}"), tr("Technician")};
    case LogEvent::OperatorPinChosen:
      return {tr("A new PIN was chosen: {}"), tr("Operator")};
    case LogEvent::TechnicianPinForgotten:
      return {tr("The PIN was forgotten: {}"), tr("Technician")};
    case LogEvent::OperatorPinForgotten:
      return {tr("The PIN was forgotten: {}"), tr("Operator")};
    case LogEvent::TouchPlain:
      return {tr("The touch screen is taken as it is.")};
    case LogEvent::TouchCorrected:
      return {tr("The touch screen was corrected")};
    case LogEvent::SettingChanged:
      return {tr("Setting “{}”: {}")};
    case LogEvent::RecordsExported:
      return {tr("Records exported: {}")};
    case LogEvent::RecordsExpired:
      return {tr("Records erased for their age: {}")};
    case LogEvent::RecordErased:
      return {tr("Record #{} was erased")};
    case LogEvent::SelfTestBegun:
      return {tr("Self-test begun")};
    case LogEvent::ConsentTaken:
      return {tr("Consent text {} was taken over")};
    case LogEvent::SettingUnknown:
      return {tr("The setting “{}” is not one: what is usual holds")};
    case LogEvent::Count:
      break;
  }
  return {""};
}

}  // namespace relievo::ui
