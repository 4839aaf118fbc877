-- SPDX-FileCopyrightText: 2026 The Relievo authors
-- SPDX-License-Identifier: GPL-3.0-or-later
--
-- Migration 9: the end of the audit log is hashed with the store's key on its own, and each line is chained to
-- it: nobody without the key can cut the log and make an earlier line the last. sqlite_audit.cc then chains
-- the lines anew. A version that knows no such end would break the chain: not compatible with 8.

UPDATE store_info SET compatible_version = 9;
