-- SPDX-FileCopyrightText: 2026 The Relievo authors
-- SPDX-License-Identifier: GPL-3.0-or-later
--
-- The store as it is today: what a new store is made from. An existing one gets here by migrations/.
-- Run inside one transaction, which also sets application_id and user_version.
--
-- Room for encryption: while key_id is NULL, name and bytes are plain. Later a subject's own key,
-- wrapped by the appliance's (encryption_key names it, never holds it), encrypts them.

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
, receipt INTEGER CHECK (receipt > 0)) STRICT;

CREATE UNIQUE INDEX receipt_of_subject ON subject (receipt);

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

-- A chain: hash = SHA-256 of the hash before and this line. subject_id is no reference on purpose:
-- the number stays when the person is erased.
CREATE TABLE audit (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  at_ms INTEGER NOT NULL,
  what TEXT NOT NULL CHECK (length(what) > 0),
  subject_id INTEGER NOT NULL,
  detail TEXT NOT NULL,
  hash BLOB NOT NULL CHECK (length(hash) = 32)
) STRICT;

CREATE TABLE audit_end (
  one INTEGER PRIMARY KEY CHECK (one = 1),
  number INTEGER NOT NULL,
  hash BLOB NOT NULL CHECK (length(hash) = 32)
) STRICT;

INSERT INTO audit_end (one, number, hash) VALUES (1, 0, zeroblob(32));

-- The oldest version of Relievo that may still open this store.
INSERT INTO store_info (one, compatible_version) VALUES (1, 5);
