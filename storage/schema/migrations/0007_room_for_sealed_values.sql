-- SPDX-FileCopyrightText: 2026 The Relievo authors
-- SPDX-License-Identifier: GPL-3.0-or-later
--
-- Migration 7: columns for what is sealed (storage/README.md, "Keys"). sqlite_sealing.cc then seals what an
-- older store holds, some people at a time; a subject whose key_id is NULL is still as it was. When none is
-- left, migration 8 drops the plain columns. A version that knows no keys could read nothing: not
-- compatible with 6.

ALTER TABLE subject ADD COLUMN name_hash BLOB;
ALTER TABLE subject ADD COLUMN code BLOB;
ALTER TABLE subject ADD COLUMN code_hash BLOB;
CREATE UNIQUE INDEX subject_of_code ON subject (code_hash);
CREATE INDEX subjects_of_name ON subject (name_hash);
CREATE INDEX subjects_without_code ON subject (id) WHERE code_hash IS NULL;
CREATE TABLE subject_key (
  block INTEGER PRIMARY KEY,
  slots BLOB NOT NULL
) STRICT;

ALTER TABLE enrolment ADD COLUMN record BLOB;
ALTER TABLE consent ADD COLUMN record BLOB;
ALTER TABLE calibration ADD COLUMN sealed_note BLOB;
ALTER TABLE audit ADD COLUMN sealed_detail BLOB;
CREATE INDEX setting_changes ON audit (number) WHERE what = 'setting.changed';

-- All settings in one value, bound to the line of the audit log that tells of their last change.
CREATE TABLE settings (
  line INTEGER NOT NULL,
  record BLOB NOT NULL
) STRICT;

-- 1: pages may still show what was plain (secure_delete leaves copies of rows that were moved).
ALTER TABLE store_info ADD COLUMN plain_traces INTEGER NOT NULL DEFAULT 0;
UPDATE store_info SET compatible_version = 7;
