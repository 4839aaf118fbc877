-- SPDX-FileCopyrightText: 2026 The Relievo authors
-- SPDX-License-Identifier: GPL-3.0-or-later
--
-- The store as it is today: what a new store is made from. An existing one gets here by migrations/.
-- Run inside one transaction, which also sets application_id and user_version.
--
-- What tells a person from another is sealed (storage/cipher/seal.h), each value bound to its table, column and
-- row: with the subject's key (name, code, record, bytes) or the device's (settings, note, detail). In the clear
-- are numbers of records, times, sizes, and the calibrations of the cameras.

CREATE TABLE store_info (
  one INTEGER PRIMARY KEY CHECK (one = 1),
  compatible_version INTEGER NOT NULL
, plain_traces INTEGER NOT NULL DEFAULT 0) STRICT;

-- Wrapped keys (storage/sqlite/sqlite_keys.h): kind says which, parameters has it.
CREATE TABLE encryption_key (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  kind TEXT NOT NULL,
  created_at_ms INTEGER NOT NULL,
  parameters BLOB
) STRICT;

-- key_id: the key that wraps this subject's. A subject without code_hash is erased; the row is about to go.
CREATE TABLE subject (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  created_at_ms INTEGER NOT NULL,
  name BLOB NOT NULL CHECK (length(name) > 0),
  key_id INTEGER REFERENCES encryption_key (id),
  name_hash BLOB, code BLOB, code_hash BLOB) STRICT;

CREATE UNIQUE INDEX subject_of_code ON subject (code_hash);
CREATE INDEX subjects_of_name ON subject (name_hash);
CREATE INDEX subjects_without_code ON subject (id) WHERE code_hash IS NULL;

-- The wrapped keys, where overwriting leaves nothing behind (storage/sqlite/sqlite_keys.h).
CREATE TABLE subject_key (
  block INTEGER PRIMARY KEY,
  slots BLOB NOT NULL
) STRICT;

CREATE TABLE calibration (
  revision INTEGER PRIMARY KEY AUTOINCREMENT,
  created_at_ms INTEGER NOT NULL,
  record BLOB NOT NULL,
  active INTEGER NOT NULL CHECK (active IN (0, 1))
, note BLOB) STRICT;

CREATE UNIQUE INDEX one_active_calibration ON calibration (active) WHERE active = 1;

CREATE TABLE enrolment (
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  subject_id INTEGER NOT NULL REFERENCES subject (id) ON DELETE CASCADE,
  created_at_ms INTEGER NOT NULL,
  calibration_revision INTEGER REFERENCES calibration (revision),
  record BLOB) STRICT;

CREATE INDEX enrolments_of_subject ON enrolment (subject_id);

CREATE TABLE consent (
  enrolment_id INTEGER PRIMARY KEY REFERENCES enrolment (id) ON DELETE CASCADE,
  record BLOB) STRICT;

-- bytes: a sealed stream, nonce its header. key_id is never used: the key is the subject's.
CREATE TABLE model (
  enrolment_id INTEGER PRIMARY KEY REFERENCES enrolment (id) ON DELETE CASCADE,
  key_id INTEGER REFERENCES encryption_key (id),
  nonce BLOB,
  bytes BLOB NOT NULL
) STRICT;

-- All settings in one value, bound to the line of the audit log that tells of their last change: an older one
-- put back is noticed.
CREATE TABLE settings (
  line INTEGER NOT NULL,
  record BLOB NOT NULL
) STRICT;

-- A chain: hash = BLAKE2b with the store's key of the end before and this line; the end's hash is BLAKE2b with
-- that key of its number and its line's hash (storage/sqlite/sqlite_parts.h). subject_id is no reference on purpose:
-- the number stays when the person is erased.
CREATE TABLE audit (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  at_ms INTEGER NOT NULL,
  what TEXT NOT NULL CHECK (length(what) > 0),
  subject_id INTEGER NOT NULL,
  hash BLOB NOT NULL CHECK (length(hash) = 32)
, detail BLOB) STRICT;

CREATE INDEX setting_changes ON audit (number) WHERE what = 'setting.changed';

CREATE TABLE audit_end (
  one INTEGER PRIMARY KEY CHECK (one = 1),
  number INTEGER NOT NULL,
  hash BLOB NOT NULL CHECK (length(hash) = 32)
) STRICT;

INSERT INTO audit_end (one, number, hash) VALUES (1, 0, zeroblob(32));

-- The oldest version of Relievo that may still open this store.
INSERT INTO store_info (one, compatible_version) VALUES (1, 9);
