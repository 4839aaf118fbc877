-- SPDX-FileCopyrightText: 2026 The Relievo authors
-- SPDX-License-Identifier: GPL-3.0-or-later
--
-- Migration 8: all is sealed, the plain columns go. Not compatible with 7, which is never more than half way.

DROP INDEX receipt_of_subject;
ALTER TABLE subject DROP COLUMN receipt;
ALTER TABLE subject DROP COLUMN name_nonce;
ALTER TABLE subject DROP COLUMN wrapped_key;
ALTER TABLE subject DROP COLUMN wrapped_key_nonce;
ALTER TABLE enrolment DROP COLUMN algorithms;
ALTER TABLE enrolment DROP COLUMN report_json;
ALTER TABLE consent DROP COLUMN wording;
ALTER TABLE consent DROP COLUMN language;
ALTER TABLE consent DROP COLUMN given_at_ms;
ALTER TABLE calibration DROP COLUMN note;
ALTER TABLE calibration RENAME COLUMN sealed_note TO note;
ALTER TABLE audit DROP COLUMN detail;
ALTER TABLE audit RENAME COLUMN sealed_detail TO detail;
DROP TABLE setting;

UPDATE store_info SET compatible_version = 8;
