-- SPDX-FileCopyrightText: 2026 The Relievo authors
-- SPDX-License-Identifier: GPL-3.0-or-later
--
-- Migration 1: subjects, consents, enrolments, models, calibrations, settings. Never edit: add another.

CREATE TABLE store_info (
  one INTEGER PRIMARY KEY CHECK (one = 1),
  compatible_version INTEGER NOT NULL
) STRICT;

CREATE TABLE encryption_key (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  kind TEXT NOT NULL,
  created_at_ms INTEGER NOT NULL,
  parameters BLOB
) STRICT;

CREATE TABLE subject (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  created_at_ms INTEGER NOT NULL,
  name BLOB NOT NULL CHECK (length(name) > 0),
  name_nonce BLOB,
  key_id INTEGER REFERENCES encryption_key (id),
  wrapped_key BLOB,
  wrapped_key_nonce BLOB
) STRICT;

CREATE TABLE calibration (
  revision INTEGER PRIMARY KEY AUTOINCREMENT,
  created_at_ms INTEGER NOT NULL,
  note TEXT NOT NULL,
  record BLOB NOT NULL,
  active INTEGER NOT NULL CHECK (active IN (0, 1))
) STRICT;

CREATE UNIQUE INDEX one_active_calibration ON calibration (active) WHERE active = 1;

CREATE TABLE enrolment (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  subject_id INTEGER NOT NULL REFERENCES subject (id) ON DELETE CASCADE,
  created_at_ms INTEGER NOT NULL,
  calibration_revision INTEGER REFERENCES calibration (revision),
  algorithms TEXT NOT NULL,
  report_json TEXT NOT NULL
) STRICT;

CREATE INDEX enrolments_of_subject ON enrolment (subject_id);

CREATE TABLE consent (
  enrolment_id INTEGER PRIMARY KEY REFERENCES enrolment (id) ON DELETE CASCADE,
  wording TEXT NOT NULL,
  language TEXT NOT NULL,
  given_at_ms INTEGER NOT NULL
) STRICT;

CREATE TABLE model (
  enrolment_id INTEGER PRIMARY KEY REFERENCES enrolment (id) ON DELETE CASCADE,
  key_id INTEGER REFERENCES encryption_key (id),
  nonce BLOB,
  bytes BLOB NOT NULL
) STRICT;

CREATE TABLE setting (
  key TEXT PRIMARY KEY CHECK (length(key) > 0),
  value TEXT NOT NULL,
  changed_at_ms INTEGER NOT NULL
) STRICT;

INSERT INTO store_info (one, compatible_version) VALUES (1, 1);
