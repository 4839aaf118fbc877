// SPDX-FileCopyrightText: 2026 The Relievo authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Visits of people who turn their heads in each way people do (tests/support/turning_person.h), several
// kiosks beside each other: machine, session, jobs and live judge are the product's, the stages make nothing.
// Time goes by with the pictures. A visit's number says who comes.
#pragma once

namespace relievo::test {

// Prints what became of them by kind of person. False: one was stuck, or of the willing less than 95 of 100
// ended with both sides.
bool turning_visits(int visits, int first_number);

}  // namespace relievo::test
