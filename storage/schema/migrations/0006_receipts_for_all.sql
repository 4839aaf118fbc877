-- SPDX-FileCopyrightText: 2026 The Relievo authors
-- SPDX-License-Identifier: GPL-3.0-or-later
--
-- Migration 6: who was enrolled before receipts were drawn gets one, too: no code is the number of a record.
-- SQLite's random() is seeded by the system.

UPDATE subject SET receipt = 1 + abs(random() % 999999999999) WHERE receipt IS NULL;
