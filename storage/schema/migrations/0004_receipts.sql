-- SPDX-FileCopyrightText: 2026 The Relievo authors
-- SPDX-License-Identifier: GPL-3.0-or-later
--
-- Migration 4: the number in the code that a person quotes for their erasure is drawn, no longer counted: nobody
-- can tell one from another. NULL: a person of before, whose code has the number of the record. A version that
-- knows no receipts would hand out codes that lead nowhere: not compatible with 3.

ALTER TABLE subject ADD COLUMN receipt INTEGER CHECK (receipt > 0);

CREATE UNIQUE INDEX receipt_of_subject ON subject (receipt);

UPDATE store_info SET compatible_version = 4;
